#include "bihive/image/image_from_film.h"

#include <algorithm>
#include <cstdint>

#include "bihive/base/parallel.h"

namespace bihive {

Image image_from_film(const Film& film, Transfer curve, int threads) {
  static const ByteTable byte_of(Transfer::srgb);
  Image image{film.width, film.height, {}};
  image.rgb.resize(3 * film.radiance.size());

  // Some rows at a time.
  constexpr std::int64_t kPixelsAtOnce = 1 << 15;
  const auto pixels = static_cast<std::int64_t>(film.radiance.size());
  parallel_for(threads, (pixels + kPixelsAtOnce - 1) / kPixelsAtOnce, [&](std::int64_t part) {
    const std::int64_t end = std::min(pixels, (part + 1) * kPixelsAtOnce);
    std::uint8_t* bytes = image.rgb.data() + 3 * part * kPixelsAtOnce;
    if (curve == Transfer::none)
      return bytes_from_radiance(&film.radiance[static_cast<std::size_t>(part * kPixelsAtOnce)].x,
                                 3 * (end - part * kPixelsAtOnce), bytes);
    for (std::int64_t i = part * kPixelsAtOnce; i < end; ++i, bytes += 3) {
      const Vec3f& pixel = film.radiance[static_cast<std::size_t>(i)];
      bytes[0] = byte_of(pixel.x);
      bytes[1] = byte_of(pixel.y);
      bytes[2] = byte_of(pixel.z);
    }
  });
  return image;
}

}  // namespace bihive
