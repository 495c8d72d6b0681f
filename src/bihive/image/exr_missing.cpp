// Builds without OpenEXR: the page, other processors, and where libopenexr-dev is not installed.
#include "bihive/base/check.h"
#include "bihive/image/exr.h"

namespace bihive {
namespace {

Error no_exr(const std::string& path) {
  return {"this build of bihive has no OpenEXR", path, 0, 0,
          "install libopenexr-dev (scripts/setup demo) and build again, or write a PNG"};
}

}  // namespace

class ExrWriter::Implementation {};

bool can_write_exr() {
  return false;
}

ExrWriter::ExrWriter(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
ExrWriter::ExrWriter(ExrWriter&& other) noexcept = default;
ExrWriter& ExrWriter::operator=(ExrWriter&& other) noexcept = default;
ExrWriter::~ExrWriter() = default;

Result<ExrWriter> ExrWriter::begin(const std::string& path, const ExrForm&) {
  return no_exr(path);
}

// Nobody has a writer.
Status ExrWriter::add(const std::vector<Channel>&) {
  return no_exr("");
}
Status ExrWriter::finish() {
  return no_exr("");
}
Status ExrWriter::replace_text(const std::string&, const std::string&) {
  return no_exr("");
}
std::string ExrWriter::path_aside() const {
  return "";
}

Status write_exr(const std::string& path, const ExrForm&) {
  return no_exr(path);
}

Result<ExrForm> read_exr(const std::string& path) {
  return no_exr(path);
}

}  // namespace bihive
