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

// Colours count by their opacity: a clear pixel has none to give to its neighbours.
void mix(const std::uint8_t* const (&corners)[4], const double (&shares)[4], int channels, std::uint8_t* out) {
  double sums[4] = {0, 0, 0, 0}, all = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double opacity = channels == 4 ? corners[corner][3] : 1;
    const double share = shares[corner] * opacity;
    all += share;
    for (int channel = 0; channel < 3; ++channel) sums[channel] += share * corners[corner][channel];
  }
  for (int channel = 0; channel < 3; ++channel)
    out[channel] = static_cast<std::uint8_t>(all > 0 ? std::floor(sums[channel] / all + 0.5) : 0);
  if (channels == 4) out[3] = static_cast<std::uint8_t>(std::floor(all + 0.5));
}

PngPixels enlarged(const PngPixels& image, int width, int height) {
  const auto channels = static_cast<std::ptrdiff_t>(image.channels);
  PngPixels large{width, height, image.channels, 8, {}, image.is_srgb};
  large.bytes.resize(large.row_bytes() * static_cast<std::size_t>(height));
  std::vector<Between> columns;
  columns.reserve(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) columns.emplace_back(x, width, image.width);
  parallel_for(0, height, [&](std::int64_t row) {
    const Between y(static_cast<int>(row), height, image.height);
    const std::uint8_t* const upper = image.bytes.data() + channels * y.low * image.width;
    const std::uint8_t* const lower = image.bytes.data() + channels * y.high * image.width;
    std::uint8_t* out = large.bytes.data() + channels * row * width;
    for (const Between& x : columns) {
      mix({upper + channels * x.low, upper + channels * x.high, lower + channels * x.low, lower + channels * x.high},
          {(1 - y.share) * (1 - x.share), (1 - y.share) * x.share, y.share * (1 - x.share), y.share * x.share},
          image.channels, out);
      out += channels;
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
  PngPixels pixels = labelled(PngPixels{image.width, image.height, 3, 8, std::move(image.rgb)}, scene, settings);
  return {pixels.width, pixels.height, std::move(pixels.bytes)};
}

PngPixels labelled(PngPixels pixels, const Scene& scene, const RenderSettings& settings) {
  RenderSettings of_labels = settings;
  of_labels.labels = possible_labels(scene, scene.camera, settings);
  if (!of_labels.labels.any()) return pixels;
  if (pixels.width != settings.width_px || pixels.height != settings.height_px)
    pixels = enlarged(pixels, settings.width_px, settings.height_px);
  draw_labels(pixels, scene, of_labels);
  return pixels;
}

}  // namespace bihive
