#include "bihive/render/picture/edge_pixels.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/parallel.h"

namespace bihive {
namespace {

// NaN gives 0.
double shown(double light) {
  return light > 0 ? std::sqrt(std::min(light, 1.0)) : 0;
}

bool differ(Vec3f a, Vec3f b) {
  for (int channel = 0; channel < 3; ++channel)
    if (std::abs(shown(double(a[channel])) - shown(double(b[channel]))) > kNeighbourContrast) return true;
  return false;
}

bool differs_from_a_neighbour(const Film& film, int x, int y) {
  const std::size_t here = film.number_of(x, y);
  for (int there_y = std::max(y - 1, 0); there_y <= std::min(y + 1, film.height - 1); ++there_y)
    for (int there_x = std::max(x - 1, 0); there_x <= std::min(x + 1, film.width - 1); ++there_x) {
      const std::size_t there = film.number_of(there_x, there_y);
      if (differ(film.radiance[here], film.radiance[there])) return true;
      if (!film.coverage.empty() &&
          std::abs(double(film.coverage[here]) - double(film.coverage[there])) > kNeighbourContrast)
        return true;
    }
  return false;
}

}  // namespace

void SampleRange::add(Vec3d light) {
  const Vec3d seen{shown(light.x), shown(light.y), shown(light.z)};
  least_ = {std::min(least_.x, seen.x), std::min(least_.y, seen.y), std::min(least_.z, seen.z)};
  most_ = {std::max(most_.x, seen.x), std::max(most_.y, seen.y), std::max(most_.z, seen.z)};
}

bool SampleRange::differs() const {
  return most_.x - least_.x > kSampleContrast || most_.y - least_.y > kSampleContrast ||
         most_.z - least_.z > kSampleContrast;
}

void EdgePixels::resize(int width_px, int height_px) {
  width_ = width_px;
  height_ = height_px;
  found_.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0);
}

void EdgePixels::find(const Film& film, int threads) {
  parallel_for(threads, height_, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_; ++x)
      if (found_[number_of(x, y)] == 0 && differs_from_a_neighbour(film, x, y)) found_[number_of(x, y)] = 1;
  });
}

}  // namespace bihive
