// Compares another renderer's picture with the CPU's, and finds out whether each differing pixel lies on an edge.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/image/image.h"
#include "bihive/render/renderer.h"
#include "bihive/render/shade/integrator.h"
#include "bihive/render/views.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/sample_pattern.h"

namespace bihive::test {

/// Compares two pictures in bytes. A pixel differs if a channel differs by more than kTolerance of 255. It lies on an
/// edge in two cases: the CPU's picture differs as much within its 3 x 3 neighbourhood; or the CPU finds a value that
/// differs as much when its primary rays are moved by a thousandth of a pixel, or less, in one of sixteen directions.
/// (Less, because a mirror image in a mirror may have details that are narrower.)
struct Agreement {
  static constexpr int kTolerance = 2;
  static constexpr double kMovedPx[3] = {1e-3, 3e-4, 1e-4};

  std::int64_t pixels = 0, differing = 0, off_edge = 0;
  int largest = 0;                    ///< the largest difference of a channel
  std::vector<std::string> examples;  ///< of pixels off any edge, at most eight

  double share() const { return pixels == 0 ? 0 : double(differing) / double(pixels); }
  std::string text() const {
    std::string line = std::to_string(differing) + " of " + std::to_string(pixels) + " pixels differ (" +
                       std::to_string(100 * share()) + " %), " + std::to_string(off_edge) +
                       " of them off any edge; largest difference " + std::to_string(largest);
    for (const std::string& example : examples) line += "\n  " + example;
    return line;
  }
};

/// One pixel of the CPU's picture, by its scalar integrator and views. The rays are moved by this many pixels.
class CpuPixel {
 public:
  /// `tracer` needs a tree for View::traversal; `range` matters to View::distance alone.
  CpuPixel(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, DistanceRange range)
      : scene_(scene),
        tracer_(tracer),
        settings_(settings),
        range_(range),
        rays_(scene.camera, settings.width_px, settings.height_px),
        integrator_(scene, tracer, settings.recursion, settings.shadows && settings.view == View::shaded) {}

  std::array<int, 3> bytes(int x, int y, double dx, double dy) {
    Vec3d sum;
    for (int i = 0; i < settings_.samples_per_pixel; ++i) {
      const SamplePlace place = sample_place(i, settings_.samples_per_pixel);
      sum = sum + value(rays_.at(x + place.x + dx, y + place.y + dy));
    }
    Film film(1, 1);
    film.at(0, 0) = to_float(sum / double(settings_.samples_per_pixel));
    const Image image = image_from_film(film, settings_.view, scene_.picture.transfer, 1);
    return {image.rgb[0], image.rgb[1], image.rgb[2]};
  }

 private:
  Vec3d value(const Ray& ray) {
    switch (settings_.view) {
      case View::shaded:
        return integrator_.radiance(ray);
      case View::recursion:
        integrator_.radiance(ray);
        return recursion_colour(integrator_.deepest_hit());
      case View::traversal:
        return traversal_colour(tracer_, ray);
      case View::normal:
        return normal_colour(scene_, ray, scene_hit(scene_, tracer_, ray));
      case View::distance:
        return distance_colour(ray, scene_hit(scene_, tracer_, ray), range_);
      case View::id:
      case View::tree:
        break;
    }
    return id_colour(scene_hit(scene_, tracer_, ray).id);
  }

  const Scene& scene_;
  const Tracer& tracer_;
  RenderSettings settings_;
  DistanceRange range_;
  PixelRays rays_;
  Integrator integrator_;
};

/// The range of distances for View::distance, as the CPU's renderer finds it.
inline DistanceRange distance_range(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  const PixelRays rays(scene.camera, settings.width_px, settings.height_px);
  DistanceRange range{INFINITY, -INFINITY};
  for (int y = 0; y < settings.height_px; ++y)
    for (int x = 0; x < settings.width_px; ++x)
      for (int i = 0; i < settings.samples_per_pixel; ++i) {
        const SamplePlace place = sample_place(i, settings.samples_per_pixel);
        const Ray ray = rays.at(x + place.x, y + place.y);
        const SceneHit hit = scene_hit(scene, tracer, ray);
        if (!hit.found()) continue;
        range.nearest = std::min(range.nearest, distance_of(ray, hit));
        range.farthest = std::max(range.farthest, distance_of(ray, hit));
      }
  return range;
}

/// `cpu` and `other` must be pictures of these settings.
inline Agreement agreement_of(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                              const Image& cpu, const Image& other) {
  BIHIVE_CHECK(cpu.width == other.width && cpu.height == other.height);
  using Bytes = std::array<int, 3>;
  const auto at = [](const Image& image, int x, int y) -> Bytes {
    const std::size_t i = 3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
  };
  const auto apart = [](const Bytes& a, const Bytes& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
  };
  const bool needs_range = settings.view == View::distance;
  CpuPixel pixel(scene, tracer, settings, needs_range ? distance_range(scene, tracer, settings) : DistanceRange{0, 0});

  Agreement agreement;
  agreement.pixels = std::int64_t{cpu.width} * cpu.height;
  for (int y = 0; y < cpu.height; ++y)
    for (int x = 0; x < cpu.width; ++x) {
      const Bytes wanted = at(cpu, x, y);
      const int difference = apart(wanted, at(other, x, y));
      agreement.largest = std::max(agreement.largest, difference);
      if (difference <= Agreement::kTolerance) continue;
      ++agreement.differing;

      // Look at its neighbourhood, then between it and its neighbours.
      bool edge = false;
      for (int v = std::max(0, y - 1); v <= std::min(cpu.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(cpu.width - 1, x + 1); ++u)
          edge = edge || apart(wanted, at(cpu, u, v)) >= difference;
      int moved = 0;
      for (const double distance : Agreement::kMovedPx)
        for (int direction = 0; direction < 16 && !edge; ++direction) {
          const double angle = direction * (3.14159265358979 / 8);
          const Bytes beside = pixel.bytes(x, y, distance * std::cos(angle), distance * std::sin(angle));
          moved = std::max(moved, apart(wanted, beside));
          edge = moved >= difference;
        }
      if (edge) continue;
      ++agreement.off_edge;
      if (agreement.examples.size() < 8)
        agreement.examples.push_back("(" + std::to_string(x) + ", " + std::to_string(y) + ") differs by " +
                                     std::to_string(difference) + ", moved rays by " + std::to_string(moved));
    }
  return agreement;
}

}  // namespace bihive::test
