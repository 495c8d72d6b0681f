// Builds without libtiff: the page, other processors, and where libtiff-dev is not installed.
#include "bihive/image/tiff.h"

namespace bihive {
namespace {

Error no_tiff(const std::string& path) {
  return {"this build of bihive has no TIFF", path, 0, 0,
          "install libtiff-dev (scripts/setup demo) and build again, or write a PNG"};
}

}  // namespace

class TiffWriter::Implementation {};

bool can_write_tiff() {
  return false;
}

TiffWriter::TiffWriter(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
TiffWriter::TiffWriter(TiffWriter&& other) noexcept = default;
TiffWriter& TiffWriter::operator=(TiffWriter&& other) noexcept = default;
TiffWriter::~TiffWriter() = default;

Result<TiffWriter> TiffWriter::begin(const std::string& path, const TiffForm&) {
  return no_tiff(path);
}

// Nobody has a writer.
Status TiffWriter::add(const PngPixels&) {
  return no_tiff("");
}
Status TiffWriter::finish(const std::string&) {
  return no_tiff("");
}
std::string TiffWriter::path_aside() const {
  return "";
}

Status write_tiff(const std::string& path, const TiffForm&, const PngPixels&) {
  return no_tiff(path);
}

Result<TiffFile> read_tiff(const std::string& path) {
  return no_tiff(path);
}

}  // namespace bihive
