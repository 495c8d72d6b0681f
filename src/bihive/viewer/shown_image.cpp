#include "bihive/viewer/shown_image.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bihive/base/parallel.h"
#include "bihive/render/renderer.h"

namespace bihive {
namespace {

constexpr int kCheckPx = 12;
constexpr double kLightCheck = 235, kDarkCheck = 205;  // display values

}  // namespace

Image image_to_show(const Film& film, View view, Transfer transfer) {
  Image image = image_from_film(film, view, transfer);
  if (film.coverage.empty()) return image;
  parallel_for(0, film.height, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < film.width; ++x) {
      const std::size_t pixel = film.number_of(x, y);
      const double coverage = double{film.coverage[pixel]};
      const double check = (x / kCheckPx + y / kCheckPx) % 2 == 0 ? kLightCheck : kDarkCheck;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
        image.rgb[i] = static_cast<std::uint8_t>(std::floor(coverage * image.rgb[i] + (1 - coverage) * check + 0.5));
    }
  });
  return image;
}

}  // namespace bihive
