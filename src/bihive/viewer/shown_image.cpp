#include "bihive/viewer/shown_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/image/png_pixels.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/renderer.h"

namespace bihive {
namespace {

constexpr int kCheckPx = 12;
constexpr double kLightCheck = 235, kDarkCheck = 205;  // display values

// Between the middles of two pixels along one side.
struct Between {
  int low, high;
  double share;  // of the higher one

  Between(int place, int places, int source_places) {
    const double at = (place + 0.5) * source_places / places - 0.5;
    const double clamped = std::clamp(at, 0.0, static_cast<double>(source_places - 1));
    low = static_cast<int>(clamped);
    high = std::min(low + 1, source_places - 1);
    share = clamped - low;
  }
};

Image enlarged_image(const Image& image, int width, int height) {
  Image large{width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height)};
  std::vector<Between> columns;
  columns.reserve(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) columns.emplace_back(x, width, image.width);
  parallel_for(0, height, [&](std::int64_t row) {
    const Between y(static_cast<int>(row), height, image.height);
    const std::uint8_t* const upper = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(y.low) * image.width;
    const std::uint8_t* const lower = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(y.high) * image.width;
    std::uint8_t* out = large.rgb.data() + 3 * static_cast<std::ptrdiff_t>(row) * width;
    for (const Between& x : columns)
      for (int channel = 0; channel < 3; ++channel) {
        const auto mixed = [&](const std::uint8_t* line) {
          return (1 - x.share) * line[3 * x.low + channel] + x.share * line[3 * x.high + channel];
        };
        *out++ = static_cast<std::uint8_t>(std::floor((1 - y.share) * mixed(upper) + y.share * mixed(lower) + 0.5));
      }
  });
  return large;
}

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

Image labelled(Image image, const Scene& scene, const RenderSettings& settings) {
  RenderSettings of_labels = settings;
  of_labels.labels = possible_labels(scene, scene.camera, settings);
  if (!of_labels.labels.any()) return image;
  if (image.width != settings.width_px || image.height != settings.height_px)
    image = enlarged_image(image, settings.width_px, settings.height_px);
  PngPixels pixels{image.width, image.height, 3, 8, std::move(image.rgb)};
  draw_labels(pixels, scene, of_labels);
  return {pixels.width, pixels.height, std::move(pixels.bytes)};
}

}  // namespace bihive
