#include "bihive/image/image.h"

namespace bihive {

PictureHash::PictureHash(int width, int height) {
  for (const int side : {width, height})
    for (int shift = 0; shift < 32; shift += 8) add({static_cast<std::uint8_t>(side >> shift & 0xFF)});
}

void PictureHash::add(const std::vector<std::uint8_t>& bytes) {
  hash_ = fnv1a({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, hash_);
}

std::uint64_t picture_hash(const Image& image) {
  PictureHash hash(image.width, image.height);
  hash.add(image.rgb);
  return hash.value();
}

}  // namespace bihive
