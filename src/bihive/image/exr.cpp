#include "bihive/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>

#include "bihive/base/check.h"
#include "bihive/base/write_file.h"

namespace bihive {
namespace {

// OpenEXR's own level, 4, writes 2 % less and takes longer (docs/decisions/0022-openexr.md).
constexpr int kExrCompressionLevel = 1;

// Of ZIP_COMPRESSION, and of a block's place in the file.
constexpr int kRowsOfBlock = 16;
constexpr int kPlaceBytes = 8;

// OpenEXR's way to a file that is written aside. OpenEXR's destructors drop exceptions, so the first fault is kept.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(const std::string& path, GrowingFile& file) : Imf::OStream(path.c_str()), file_(file) {}

  void write(const char bytes[], int count) override {
    if (!fault_) {
      const Status status = file_.write_at(place_, {bytes, static_cast<std::size_t>(count)});
      if (!status) fault_ = status.error();
    }
    if (keeps_header_) {
      header_.resize(std::max(header_.size(), static_cast<std::size_t>(place_) + static_cast<std::size_t>(count)));
      std::copy(bytes, bytes + count, header_.begin() + static_cast<std::ptrdiff_t>(place_));
    }
    if (counts_places_ && count == kPlaceBytes && std::any_of(bytes, bytes + count, [](char c) { return c != 0; }))
      ++places_;
    if (fault_) throw std::runtime_error(fault_->message);
    place_ += static_cast<std::uint64_t>(count);
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }

  /// From now on the places of the blocks are written. OpenEXR drops faults of its own there and in blocks, for example
  /// a lack of memory; a block that is missing has the place 0.
  void count_places() { counts_places_ = true; }
  int places() const { return places_; }

  /// Until now the file's header was written. Replaces a part of it.
  void end_header() { keeps_header_ = false; }
  Status replace_in_header(const std::string& before, const std::string& after) {
    const std::size_t place = header_.rfind(before);
    BIHIVE_CHECK(place != std::string::npos);
    BIHIVE_CHECK_EQ(before.size(), after.size());
    return file_.write_at(place, after);
  }

  /// The first fault of the file.
  const std::optional<Error>& fault() const { return fault_; }

 private:
  GrowingFile& file_;
  std::uint64_t place_ = 0;
  bool counts_places_ = false, keeps_header_ = true;
  std::string header_;
  int places_ = 0;
  std::optional<Error> fault_;
};

Imf::PixelType exr_type(const Channel& channel) {
  return channel.of_ids ? Imf::UINT : Imf::FLOAT;
}

Imf::Header exr_header(const ExrForm& form) {
  // The last column and row belong to OpenEXR's windows.
  const Tile& part = form.pixels;
  Imf::Header header(Imath::Box2i({0, 0}, {form.width_px - 1, form.height_px - 1}),
                     Imath::Box2i({part.x0, part.y0}, {part.x1 - 1, part.y1 - 1}));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = kExrCompressionLevel;
  Imf::addChromaticities(header, Imf::Chromaticities());
  if (form.dots_per_inch > 0) Imf::addXDensity(header, static_cast<float>(form.dots_per_inch));
  for (const auto& [name, text] : form.text) header.insert(name, Imf::StringAttribute(text));
  for (const Channel& channel : form.channels) {
    BIHIVE_CHECK(header.channels().findChannel(channel.name) == nullptr);
    header.channels().insert(channel.name, Imf::Channel(exr_type(channel)));
  }
  return header;
}

// Calls work(), whose exceptions become an Error.
template <class Work>
Status without_exceptions(const std::string& path, const std::optional<ExrStream>& stream, const Work& work) {
  try {
    work();
  } catch (const std::exception& fault) {
    if (stream && stream->fault()) return *stream->fault();
    return Error{std::string("OpenEXR: ") + fault.what(), path, 0, 0, ""};
  }
  if (stream && stream->fault()) return *stream->fault();
  return Done{};
}

}  // namespace

bool can_write_exr() {
  return true;
}

class ExrWriter::Implementation {
 public:
  Implementation(std::string path, const ExrForm& form, GrowingFile file)
      : path_(std::move(path)), part_(form.pixels), next_y_(form.pixels.y0), file_(std::move(file)) {}

  Status begin(const ExrForm& form) {
    return without_exceptions(path_, stream_, [&] {
      stream_.emplace(path_, file_);
      output_.emplace(*stream_, exr_header(form));
      stream_->end_header();
    });
  }

  Status add(const std::vector<Channel>& channels) {
    const auto width = static_cast<std::size_t>(part_.width());
    const Channel& first = channels.front();
    const std::size_t rows = (first.of_ids ? first.ids.size() : first.numbers.size()) / width;
    if (rows == 0) return Done{};
    BIHIVE_CHECK(rows <= static_cast<std::size_t>(part_.y1 - next_y_));
    return without_exceptions(path_, stream_, [&] {
      Imf::FrameBuffer buffer;
      for (const Channel& channel : channels) {
        BIHIVE_CHECK_EQ(channel.of_ids ? channel.ids.size() : channel.numbers.size(), rows * width);
        const void* const values = channel.of_ids ? static_cast<const void*>(channel.ids.data())
                                                  : static_cast<const void*>(channel.numbers.data());
        buffer.insert(channel.name, Imf::Slice::Make(exr_type(channel), values, Imath::V2i(part_.x0, next_y_),
                                                     part_.width(), static_cast<std::int64_t>(rows)));
      }
      output_->setFrameBuffer(buffer);
      output_->writePixels(static_cast<int>(rows));
      next_y_ += static_cast<int>(rows);
    });
  }

  Status finish() {
    BIHIVE_CHECK_EQ(next_y_, part_.y1);
    // Its destructor writes the places of the lines.
    stream_->count_places();
    const Status written = without_exceptions(path_, stream_, [&] { output_.reset(); });
    if (!written) return written;
    if (stream_->fault()) return *stream_->fault();
    const int blocks = (part_.height() + kRowsOfBlock - 1) / kRowsOfBlock;
    if (stream_->places() != blocks)
      return Error{"OpenEXR left out rows, as it does where memory ends", path_, 0, 0, ""};
    return file_.finish();
  }

  Status replace_text(const std::string& before, const std::string& after) {
    return stream_->replace_in_header(before, after);
  }
  const GrowingFile& file() const { return file_; }

 private:
  std::string path_;
  Tile part_;
  int next_y_;
  GrowingFile file_;
  std::optional<ExrStream> stream_;
  std::optional<Imf::OutputFile> output_;  // before the stream in its destruction
};

ExrWriter::ExrWriter(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
ExrWriter::ExrWriter(ExrWriter&& other) noexcept = default;
ExrWriter& ExrWriter::operator=(ExrWriter&& other) noexcept = default;
ExrWriter::~ExrWriter() = default;

Result<ExrWriter> ExrWriter::begin(const std::string& path, const ExrForm& form) {
  BIHIVE_CHECK(!form.channels.empty());
  Result<GrowingFile> file = GrowingFile::begin(path);
  if (!file) return file.error();
  if (!file->can_go_back()) return Error{"an OpenEXR file cannot be a pipe or a device", path, 0, 0, ""};
  auto implementation = std::make_unique<Implementation>(path, form, std::move(*file));
  if (Status status = implementation->begin(form); !status) return status.error();
  return ExrWriter(std::move(implementation));
}

Status ExrWriter::add(const std::vector<Channel>& channels) {
  return implementation_->add(channels);
}
Status ExrWriter::finish() {
  return implementation_->finish();
}
Status ExrWriter::replace_text(const std::string& before, const std::string& after) {
  return implementation_->replace_text(before, after);
}
std::string ExrWriter::path_aside() const {
  return implementation_->file().path_aside();
}

Status write_exr(const std::string& path, const ExrForm& form) {
  Result<ExrWriter> writer = ExrWriter::begin(path, form);
  if (!writer) return writer.error();
  if (Status status = writer->add(form.channels); !status) return status;
  return writer->finish();
}

namespace {

// Memory for the numbers of each channel, which OpenEXR fills.
Imf::FrameBuffer buffer_for(ExrForm& form, const Imf::ChannelList& list) {
  const Tile& part = form.pixels;
  const auto count = static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height());
  for (auto one = list.begin(); one != list.end(); ++one) {
    const bool of_ids = one.channel().type == Imf::UINT;
    if ((!of_ids && one.channel().type != Imf::FLOAT) || one.channel().xSampling != 1 || one.channel().ySampling != 1)
      throw std::runtime_error("the channel " + std::string(one.name()) + " has no numbers of 32 bits");
    form.channels.push_back(
        {one.name(), of_ids, std::vector<float>(of_ids ? 0 : count), std::vector<std::uint32_t>(of_ids ? count : 0)});
  }
  Imf::FrameBuffer buffer;
  for (Channel& channel : form.channels) {
    void* const values =
        channel.of_ids ? static_cast<void*>(channel.ids.data()) : static_cast<void*>(channel.numbers.data());
    buffer.insert(channel.name, Imf::Slice::Make(exr_type(channel), values, Imath::V2i(part.x0, part.y0), part.width(),
                                                 part.height()));
  }
  return buffer;
}

}  // namespace

Result<ExrForm> read_exr(const std::string& path) {
  constexpr int kLargestSide = 65535;
  ExrForm form;
  const Status status = without_exceptions(path, std::nullopt, [&] {
    Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    const Imath::Box2i &whole = header.displayWindow(), &part = header.dataWindow();
    const auto fits = [](const Imath::Box2i& box) {
      return box.min.x >= 0 && box.min.y >= 0 && box.max.x >= box.min.x && box.max.y >= box.min.y &&
             box.max.x < kLargestSide && box.max.y < kLargestSide;
    };
    if (!fits(whole) || !fits(part)) throw std::runtime_error("its windows are too large");
    form.width_px = whole.max.x + 1;
    form.height_px = whole.max.y + 1;
    form.pixels = {part.min.x, part.min.y, part.max.x + 1, part.max.y + 1};
    for (auto one = header.begin(); one != header.end(); ++one)
      if (const auto* const text = dynamic_cast<const Imf::StringAttribute*>(&one.attribute()))
        form.text.emplace_back(one.name(), text->value());
    const Imf::FrameBuffer buffer = buffer_for(form, header.channels());
    file.setFrameBuffer(buffer);
    file.readPixels(part.min.y, part.max.y);
  });
  if (!status) return status.error();
  return form;
}

}  // namespace bihive
