#include "bihive/io/frames/raw_frames.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/write_file.h"
#include "bihive/io/data_path.h"
#include "bihive/io/formats/foreign.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/frames/frame_index.h"
#include "bihive/io/frames/kept_index.h"
#include "bihive/io/known_formats.h"
#include "bihive/io/packed/unpacked_file.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The trajectory that is no file of spheres, by its first bytes or by its name (empty: not); null if it is none.
const TrajectoryFormat* lone_trajectory(std::string_view head, const std::string& name) {
  for (const TrajectoryFormat* format : trajectory_formats()) {
    const bool has_mark = !format->mark.empty() && head.substr(0, format->mark.size()) == format->mark;
    if (!format->alone.empty() && (has_mark || format->recognise(head) || is_named_so(format->files, name)))
      return format;
  }
  return nullptr;
}

// The content tells, then the name. A format that is known and not read, or not without another file, is named.
Result<const Format*> known_format(std::string_view head, const std::string& name, bool with_columns) {
  const ForeignFormat* foreign = foreign_before_all(head);
  if (foreign == nullptr)
    if (const Format* const format = format_by_content(head, name)) return format;
  if (foreign == nullptr) foreign = foreign_by_content(head);
  const Format* const named = foreign != nullptr ? nullptr : format_by_name(name);
  if (const auto* lone = lone_trajectory(head, foreign != nullptr || named != nullptr ? "" : name))
    return Error{"this is " + std::string(lone->alone) + ", which is read only together with a file of its atoms", name,
                 0, 0, "give that file first, as in 'bihive render ATOMS.gro FILE'"};
  if (named != nullptr) return named;
  if (foreign == nullptr) foreign = foreign_by_name(name);
  if (foreign != nullptr)
    return Error{"this is " + std::string(foreign->name) + ", which bihive does not read", name, 0, 0,
                 std::string(foreign->advice)};
  // A table whose header has no x, y and z.
  if (with_columns && head.find('\0') == std::string_view::npos) return &format_named("CSV");
  return Error{"this is no file of spheres in a known format", name, 0, 0, "known are " + known_formats()};
}

Result<const Format*> find_format(std::string_view head, const std::string& name, const ColumnChoice& columns) {
  const Result<const Format*> format = known_format(head, name, !columns.empty());
  if (format && !columns.empty() && !(*format)->has(Format::kColumns))
    return Error{"the columns of this format cannot be chosen", name, 0, 0,
                 "they can for " + names_of_formats(FormatsThat::have_columns)};
  return format;
}

// Bytes that the caller keeps.
class BytesInMemory : public RawFrames {
 public:
  BytesInMemory(std::string_view bytes, std::string name, const Format& format, ColumnChoice columns)
      : bytes_(bytes), name_(std::move(name)), format_(format), columns_(std::move(columns)) {
    set_may_be_cut(format.has(Format::kText) && bytes.back() != '\n');
  }
  Result<RawSpheres> read(std::int64_t frame) const override {
    return read_bytes(format_, bytes_, name_, frame, columns_);
  }
  bool reads_each_apart() const override { return std::holds_alternative<TextReader>(format_.reader); }

 private:
  std::string_view bytes_;
  std::string name_;
  const Format& format_;
  ColumnChoice columns_;
};

// A file that is read as a whole for each frame.
class WholeFile : public RawFrames {
 public:
  WholeFile(RandomFile file, const Format& format, ColumnChoice columns)
      : file_(std::move(file)), format_(format), columns_(std::move(columns)) {}

  Result<RawSpheres> read(std::int64_t frame) const override {
    if (Status status = check_memory(static_cast<double>(file_.size()), "the file"); !status)
      return Error{status.error().message, file_.path(), 0, 0, ""};
    const Result<std::string> bytes = file_.read(0, file_.size());
    if (!bytes) return bytes.error();
    return read_bytes(format_, *bytes, file_.path(), frame, columns_);
  }
  bool reads_each_apart() const override { return false; }
  Status look_at_end() {
    const Result<std::string> last = file_.read(file_.size() - 1, 1);
    if (!last) return last.error();
    set_may_be_cut(format_.has(Format::kText) && last->front() != '\n');
    return Done{};
  }

 private:
  RandomFile file_;
  const Format& format_;
  ColumnChoice columns_;
};

// A text with many frames on the disk.
class IndexedText : public RawFrames {
 public:
  IndexedText(RandomFile file, const Format& format, ColumnChoice columns)
      : file_(std::move(file)), format_(format), columns_(std::move(columns)) {}

  // From the index beside the file, or by a pass that writes it.
  Result<RawSpheres> open_with_index(std::int64_t wanted) {
    if (!file_.has_path()) {
      warn(file_.path() + ": there is no index of a packed file or a pipe");
      return open(wanted);
    }
    const std::string path = kept_index_path(file_.path());
    const IndexedFile of{format_.index_number, file_.size(), file_.stamp()};
    const Result<std::optional<std::string>> bytes = read_kept_index(path);
    if (!bytes) {
      warn(path + ": " + bytes.error().message + ", so it is not used");
      return open(wanted);
    }
    if (*bytes && !looks_like_index(**bytes)) {
      warn(path + ": is no index of bihive, so it stays as it is, and none is kept");
      return open(wanted);
    }
    if (*bytes) {
      std::optional<FrameIndex> index = decode_index(**bytes, of);
      if (index && take_kept(std::move(*index))) {
        Result<RawSpheres> read = this->read(wanted);
        if (read || wanted < 0 || wanted >= index_.count()) return read;
      }
      kept_ = false;
      index_ = {};
      warn(path + ": is damaged, or belongs to another version of the file; it is made anew");
    }
    Result<RawSpheres> read = open(wanted);
    if (!read) return read;
    if (const Status status = write_file(path, encode_index(index_, of)); !status)
      warn("the index is not kept: " + status.error().to_string());
    return read;
  }

  // Passes over the whole file once.
  Result<RawSpheres> open(std::int64_t wanted) {
    // Where the file is larger than the memory, a frame may be too. Then find its length first.
    const bool is_large = static_cast<double>(file_.size()) > memory_bytes();
    bool is_cut = false;
    Result<RawSpheres> read =
        pass({0, file_.size(), 0}, FramePass{is_large ? FramePass::kNone : wanted, 0, &index_}, &is_cut);
    set_may_be_cut(is_cut);
    return !read || !is_large ? std::move(read) : this->read(wanted);
  }

  Result<RawSpheres> read(std::int64_t frame) const override {
    if (file_.changed()) return changed();
    Result<RawSpheres> read = frame >= 0 && frame < index_.count() ? read_indexed(frame) : read_behind(frame);
    if (!read && file_.changed()) return changed();
    return read;
  }

 private:
  Error changed() const {
    return {"the file changed while it was read", file_.path(), 0, 0, "begin again when it is complete"};
  }

  Result<RawSpheres> read_indexed(std::int64_t frame) const {
    const TextPlace place = index_.frames[static_cast<std::size_t>(frame)];
    const std::string what = index_.count() == 1 ? "the file" : "frame " + std::to_string(frame);
    if (Status status = check_memory(static_cast<double>(place.end - place.begin), what); !status)
      return Error{status.error().message, file_.path(), 0, 0, ""};
    if (!kept_) return pass(place, FramePass{frame, frame, nullptr, &index_, &file_});

    // An index that was kept may be wrong: its bytes must be this one frame, and the lines must go on after it.
    FrameIndex found;
    Result<RawSpheres> read = pass(place, FramePass{frame, frame, &found, &index_, &file_});
    const bool is_last = frame + 1 == index_.count();
    const std::int64_t lines = is_last ? index_.lines : index_.frames[static_cast<std::size_t>(frame) + 1].lines_before;
    const bool fits = read && found.count() == 1 && found.frames[0].begin == place.begin &&
                      found.frames[0].end == place.end && found.lines == lines;
    if (fits) return read;
    // The file itself may have a fault.
    if (Result<RawSpheres> plain = pass({0, file_.size(), 0}, FramePass{frame}); !plain) return plain;
    return Error{"the index of its frames does not fit it", file_.path(), 0, 0,
                 "remove " + kept_index_path(file_.path())};
  }

  // Takes an index from the disk. False: frames follow its last one, or it does not know of the text that does.
  bool take_kept(FrameIndex index) {
    const Result<std::string> last = file_.read(file_.size() - 1, 1);
    if (!last) return false;
    index_ = std::move(index);
    kept_ = true;
    set_may_be_cut(last->front() != '\n');
    FrameIndex found;
    const Result<RawSpheres> rest = pass({index_.frames.back().end, file_.size(), index_.lines},
                                         FramePass{FramePass::kNone, index_.count(), &found});
    return rest && found.frames.empty() && found.text_behind == index_.text_behind;
  }

  // The reader's error where it meets the end of the file before that frame.
  Result<RawSpheres> read_behind(std::int64_t frame) const {
    const std::int64_t begin = index_.frames.empty() ? 0 : index_.frames.back().end;
    return pass({begin, file_.size(), index_.lines}, FramePass{frame, index_.count()});
  }

  Result<RawSpheres> pass(const TextPlace& place, FramePass request, bool* is_cut = nullptr) const {
    request.columns = columns_;
    FileText part{file_, place.begin, place.end, place.lines_before, {}};
    const TextScanner scanner(part);
    if (is_cut != nullptr) *is_cut = !scanner.ends_in_newline();
    Result<RawSpheres> read = (*std::get_if<TextReader>(&format_.reader))(scanner, request);
    if (part.fault) return *part.fault;
    return read;
  }

  RandomFile file_;
  const Format& format_;
  ColumnChoice columns_;
  FrameIndex index_;
  bool kept_ = false;  // the index comes from the disk
};

template <class Kind>
Result<OpenedFrames> opened(std::shared_ptr<const Kind> frames, Result<RawSpheres> wanted) {
  if (!wanted) return wanted.error();
  return OpenedFrames{std::move(frames), std::move(*wanted)};
}

Error empty_file(const std::string& name) {
  return {"the file is empty", name, 0, 0, ""};
}

}  // namespace

Result<OpenedFrames> open_raw_frames(std::string_view bytes, const std::string& name, std::int64_t wanted,
                                     const ColumnChoice& columns) {
  if (bytes.empty()) return empty_file(name);
  const Result<const Format*> format =
      find_format(bytes.substr(0, static_cast<std::size_t>(kFileHeadBytes)), name, columns);
  if (!format) return format.error();
  auto frames = std::make_shared<const BytesInMemory>(bytes, name, **format, columns);
  Result<RawSpheres> read = frames->read(wanted);
  return opened(std::move(frames), std::move(read));
}

Result<OpenedFrames> open_raw_frames(const std::string& path, std::int64_t wanted, bool keep_index,
                                     const ColumnChoice& columns) {
  const DataPath named = data_path(path);
  Result<RandomFile> file = open_unpacked(named.file);
  if (!file) return file.error();
  if (file->size() == 0) return empty_file(path);
  const Result<std::string> head = file->read(0, std::min(kFileHeadBytes, file->size()));
  if (!head) return head.error();
  const Result<const Format*> format = find_format(*head, path, columns);
  if (!format) return format.error();

  if (!named.inside.empty() && !(*format)->has(Format::kDataSets))
    return Error{"names of data sets are for HDF5 files, and this is none: " + quote(named.inside), path, 0, 0, ""};
  if (const auto* open = std::get_if<FramesOpener>(&(*format)->reader)) {
    Result<std::shared_ptr<const RawFrames>> frames = (*open)(std::move(*file), named.inside, columns);
    if (!frames) return frames.error();
    Result<RawSpheres> read = (*frames)->read(wanted);
    return opened(std::move(*frames), std::move(read));
  }
  if (std::holds_alternative<TextReader>((*format)->reader)) {
    auto frames = std::make_shared<IndexedText>(std::move(*file), **format, columns);
    Result<RawSpheres> read = keep_index ? frames->open_with_index(wanted) : frames->open(wanted);
    return opened<IndexedText>(std::move(frames), std::move(read));
  }
  auto frames = std::make_shared<WholeFile>(std::move(*file), **format, columns);
  if (Status status = frames->look_at_end(); !status) return status.error();
  Result<RawSpheres> read = frames->read(wanted);
  return opened<WholeFile>(std::move(frames), std::move(read));
}

}  // namespace bihive
