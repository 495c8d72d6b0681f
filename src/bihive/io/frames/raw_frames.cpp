#include "bihive/io/frames/raw_frames.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/write_file.h"
#include "bihive/io/data_path.h"
#include "bihive/io/formats/arrays/array_frames.h"
#include "bihive/io/formats/arrays/gsd.h"
#include "bihive/io/formats/detect.h"
#include "bihive/io/formats/foreign.h"
#include "bihive/io/formats/readers.h"
#include "bihive/io/frames/frame_index.h"
#include "bihive/io/frames/kept_index.h"
#include "bihive/io/packed/unpacked_file.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The content of a file shows its format within so many bytes.
constexpr std::int64_t kHead = 65536;

bool has_columns(Format format) {
  switch (format) {
    case Format::xyz:
    case Format::lammps_dump:
    case Format::ply:
    case Format::pcd:
    case Format::vtk_legacy:
    case Format::vtk_xml:
    case Format::csv:
    case Format::npy:
    case Format::npz:
    case Format::hdf5:
    case Format::netcdf:
      return true;
    default:
      return false;
  }
}

// The content tells, then the name. A format that is known and not read, or not without another file, is named.
Result<Format> known_format(std::string_view head, const std::string& name, bool with_columns) {
  if (const auto format = format_by_content(head, name)) return *format;
  std::optional<ForeignFormat> foreign = foreign_by_content(head);
  if (!foreign) {
    if (const auto format = format_by_name(name)) return *format;
    foreign = foreign_by_name(name);
  }
  if (foreign) {
    const char* const why = foreign->needs_atoms ? ", which is read only together with a file of its atoms"
                                                 : ", which bihive does not read";
    return Error{"this is " + foreign->name + why, name, 0, 0, foreign->advice};
  }
  // A table whose header has no x, y and z.
  if (with_columns && head.find('\0') == std::string_view::npos) return Format::csv;
  return Error{"this is no file of spheres in a known format", name, 0, 0, "known are " + known_formats()};
}

Result<Format> find_format(std::string_view head, const std::string& name, const ColumnChoice& columns) {
  const Result<Format> format = known_format(head, name, !columns.empty());
  if (format && !columns.empty() && !has_columns(*format))
    return Error{"the columns of this format cannot be chosen", name, 0, 0,
                 "they can for CSV, XYZ, LAMMPS dumps, NPY, NPZ, PLY, PCD, VTK, HDF5 and NetCDF"};
  return format;
}

Result<RawSpheres> read_whole(Format format, std::string_view bytes, const std::string& name, std::int64_t frame,
                              const ColumnChoice& columns) {
  FramePass pass{frame};
  pass.columns = columns;
  switch (format) {
    case Format::pdb:
      return read_pdb(bytes, name, frame);
    case Format::pqr:
      return read_pqr(bytes, name, frame);
    case Format::mmcif:
      // The head of a long CIF may hold no atoms yet.
      return is_small_cif(bytes) ? read_small_cif(bytes, name, frame) : read_mmcif(bytes, name, frame);
    case Format::xyz:
      return read_xyz(TextScanner(bytes, name), pass);
    case Format::gro:
      return read_gro(bytes, name, frame);
    case Format::lammps_dump:
      return read_lammps_dump(TextScanner(bytes, name), pass);
    case Format::lammps_data:
      return read_lammps_data(bytes, name, frame);
    case Format::poscar:
      return read_poscar(bytes, name, frame);
    case Format::xdatcar:
      return read_xdatcar(bytes, name, frame);
    case Format::sdf:
      return read_sdf(bytes, name, frame);
    case Format::mol2:
      return read_mol2(bytes, name, frame);
    case Format::small_cif:
      return read_small_cif(bytes, name, frame);
    case Format::ply:
      return read_ply(bytes, name, frame, columns);
    case Format::pcd:
      return read_pcd(bytes, name, frame, columns);
    case Format::vtk_legacy:
      return read_vtk_legacy(bytes, name, frame, columns);
    case Format::vtk_xml:
      return read_vtk_xml(bytes, name, frame, columns);
    case Format::gsd:
      return read_gsd(bytes, name, frame);
    case Format::csv:
      return read_csv(bytes, name, frame, columns);
    case Format::npy:
      return read_npy(bytes, name, frame, columns);
    case Format::npz:
      return read_npz(bytes, name, frame, columns);
    case Format::hdf5:
    case Format::netcdf: {
      const Result<std::shared_ptr<const RawFrames>> frames =
          open_array_frames(RandomFile::of_bytes(bytes, name), "", columns);
      if (!frames) return frames.error();
      return (*frames)->read(frame);
    }
  }
  return Error{"unknown format", name, 0, 0, ""};
}

using PassReader = Result<RawSpheres> (*)(const TextScanner&, const FramePass&);

// The reader that can pass over frames; null: the format has none.
PassReader pass_reader(Format format) {
  switch (format) {
    case Format::pdb:
      return [](const TextScanner& text, const FramePass& pass) { return read_pdb(text, pass); };
    case Format::pqr:
      return [](const TextScanner& text, const FramePass& pass) { return read_pqr(text, pass); };
    case Format::xyz:
      return [](const TextScanner& text, const FramePass& pass) { return read_xyz(text, pass); };
    case Format::gro:
      return [](const TextScanner& text, const FramePass& pass) { return read_gro(text, pass); };
    case Format::lammps_dump:
      return [](const TextScanner& text, const FramePass& pass) { return read_lammps_dump(text, pass); };
    default:
      return nullptr;
  }
}

// Whether the last line of every whole file has an end.
bool ends_in_a_line(Format format) {
  switch (format) {
    case Format::npy:
    case Format::npz:
    case Format::gsd:
    case Format::hdf5:
    case Format::netcdf:
    case Format::ply:
    case Format::pcd:
    case Format::vtk_legacy:
    case Format::vtk_xml:
      return false;
    default:
      return true;
  }
}

// Bytes that the caller keeps.
class BytesInMemory : public RawFrames {
 public:
  BytesInMemory(std::string_view bytes, std::string name, Format format, ColumnChoice columns)
      : bytes_(bytes), name_(std::move(name)), format_(format), columns_(std::move(columns)) {
    set_may_be_cut(ends_in_a_line(format) && bytes.back() != '\n');
  }
  Result<RawSpheres> read(std::int64_t frame) const override {
    return read_whole(format_, bytes_, name_, frame, columns_);
  }

 private:
  std::string_view bytes_;
  std::string name_;
  Format format_;
  ColumnChoice columns_;
};

// A file that is read as a whole for each frame.
class WholeFile : public RawFrames {
 public:
  WholeFile(RandomFile file, Format format, ColumnChoice columns)
      : file_(std::move(file)), format_(format), columns_(std::move(columns)) {}

  Result<RawSpheres> read(std::int64_t frame) const override {
    if (Status status = check_memory(static_cast<double>(file_.size()), "the file"); !status)
      return Error{status.error().message, file_.path(), 0, 0, ""};
    const Result<std::string> bytes = file_.read(0, file_.size());
    if (!bytes) return bytes.error();
    return read_whole(format_, *bytes, file_.path(), frame, columns_);
  }
  Status look_at_end() {
    const Result<std::string> last = file_.read(file_.size() - 1, 1);
    if (!last) return last.error();
    set_may_be_cut(ends_in_a_line(format_) && last->front() != '\n');
    return Done{};
  }

 private:
  RandomFile file_;
  Format format_;
  ColumnChoice columns_;
};

class GsdFrames : public RawFrames {
 public:
  explicit GsdFrames(GsdFile file) : file_(std::move(file)) {}
  Result<RawSpheres> read(std::int64_t frame) const override { return read_gsd_frame(file_, frame); }

 private:
  GsdFile file_;
};

// A text with many frames on the disk.
class IndexedText : public RawFrames {
 public:
  IndexedText(RandomFile file, Format format, ColumnChoice columns)
      : file_(std::move(file)), format_(format), reader_(pass_reader(format)), columns_(std::move(columns)) {}

  // From the index beside the file, or by a pass that writes it.
  Result<RawSpheres> open_with_index(std::int64_t wanted) {
    if (!file_.has_path()) {
      warn(file_.path() + ": there is no index of a packed file or a pipe");
      return open(wanted);
    }
    const std::string path = kept_index_path(file_.path());
    const IndexedFile of{format_, file_.size(), file_.stamp()};
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

  Result<RawSpheres> pass(const TextPlace& place, FramePass wish, bool* is_cut = nullptr) const {
    wish.columns = columns_;
    FileText part{file_, place.begin, place.end, place.lines_before, {}};
    const TextScanner scanner(part);
    if (is_cut != nullptr) *is_cut = !scanner.ends_in_newline();
    Result<RawSpheres> read = reader_(scanner, wish);
    if (part.fault) return *part.fault;
    return read;
  }

  RandomFile file_;
  Format format_;
  PassReader reader_;
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
  const Result<Format> format = find_format(bytes.substr(0, static_cast<std::size_t>(kHead)), name, columns);
  if (!format) return format.error();
  auto frames = std::make_shared<const BytesInMemory>(bytes, name, *format, columns);
  Result<RawSpheres> read = frames->read(wanted);
  return opened(std::move(frames), std::move(read));
}

Result<OpenedFrames> open_raw_frames(const std::string& path, std::int64_t wanted, bool keep_index,
                                     const ColumnChoice& columns) {
  const DataPath named = data_path(path);
  Result<RandomFile> file = open_unpacked(named.file);
  if (!file) return file.error();
  if (file->size() == 0) return empty_file(path);
  const Result<std::string> head = file->read(0, std::min(kHead, file->size()));
  if (!head) return head.error();
  const Result<Format> format = find_format(*head, path, columns);
  if (!format) return format.error();

  const bool has_arrays = *format == Format::hdf5 || *format == Format::netcdf;
  if (!named.inside.empty() && !has_arrays)
    return Error{"names of data sets are for HDF5 files, and this is none: " + quote(named.inside), path, 0, 0, ""};
  if (has_arrays) {
    Result<std::shared_ptr<const RawFrames>> frames = open_array_frames(std::move(*file), named.inside, columns);
    if (!frames) return frames.error();
    Result<RawSpheres> read = (*frames)->read(wanted);
    return opened(std::move(*frames), std::move(read));
  }
  if (pass_reader(*format) != nullptr) {
    auto frames = std::make_shared<IndexedText>(std::move(*file), *format, columns);
    Result<RawSpheres> read = keep_index ? frames->open_with_index(wanted) : frames->open(wanted);
    return opened<IndexedText>(std::move(frames), std::move(read));
  }
  if (*format == Format::gsd) {
    Result<GsdFile> gsd = GsdFile::open(std::move(*file));
    if (!gsd) return gsd.error();
    auto frames = std::make_shared<const GsdFrames>(std::move(*gsd));
    Result<RawSpheres> read = frames->read(wanted);
    return opened(std::move(frames), std::move(read));
  }
  auto frames = std::make_shared<WholeFile>(std::move(*file), *format, columns);
  if (Status status = frames->look_at_end(); !status) return status.error();
  Result<RawSpheres> read = frames->read(wanted);
  return opened<WholeFile>(std::move(frames), std::move(read));
}

}  // namespace bihive
