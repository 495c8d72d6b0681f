#include "bihive/image/image.h"

namespace bihive {

std::uint64_t picture_hash(const Image& image) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&hash](std::uint8_t byte) { hash = (hash ^ byte) * 0x100000001B3u; };
  for (const int side : {image.width, image.height})
    for (int shift = 0; shift < 32; shift += 8) add(static_cast<std::uint8_t>(side >> shift & 0xFF));
  for (const std::uint8_t byte : image.rgb) add(byte);
  return hash;
}

}  // namespace bihive
