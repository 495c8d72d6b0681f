// Draws figures of `bihive render` again from their records, and compares the SHA-256 of the pixels: `bihive verify`
// for machines without libpng.
//   figure_pixels FIGURE.png...     prints "FIGURE.png: the same bits", or what differs; exit code 1 if one does not
//   hold
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "bihive/base/sha256.h"
#include "bihive/base/write_file.h"
#include "bihive/job/draw_again.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_record.h"

namespace {

using namespace bihive;

// The text `bihive` of a PNG; empty: there is none.
std::string record_in(std::string_view png) {
  constexpr std::size_t kSignature = 8, kBeforeContent = 8, kCheckSum = 4;
  const std::string keyword = std::string("bihive") + '\0';
  for (std::size_t at = kSignature; at + kBeforeContent <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(png[at + i]);
    const std::string_view content = png.substr(at + kBeforeContent, length);
    if (png.substr(at + 4, 4) == "tEXt" && content.starts_with(keyword))
      return std::string(content.substr(keyword.size()));
    at += kBeforeContent + length + kCheckSum;
  }
  return "";
}

bool holds(const std::string& path) {
  const std::string png = value_or_fail(read_file(path));
  const PictureRecord record = value_or_fail(picture_record_from(record_in(png)));
  const PictureRequest request = request_again(record, ".", "", {});
  const bool same = changed_files(record, request).empty() && sha256_of(draw_again(request)) == record.pixels_sha256;
  std::printf("%s: %s\n", path.c_str(), same ? "the same bits" : "other pixels or inputs");
  return same;
}

}  // namespace

int main(int count, char** words) {
  bool all = count > 1;
  for (int i = 1; i < count; ++i) {
    try {
      all = holds(words[i]) && all;
    } catch (const Failure& failure) {
      std::printf("%s: %s\n", words[i], failure.error.to_string().c_str());
      all = false;
    }
    std::fflush(stdout);
  }
  return all ? 0 : 1;
}
