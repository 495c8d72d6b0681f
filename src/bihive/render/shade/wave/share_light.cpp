#include <algorithm>
#include <cstddef>

#include "bihive/render/shade/wave/wave.h"

namespace bihive::steps {
namespace {

// A window of 5 x 3 pixels whose outermost ones count half: each of the sets that a block of 4 x 2 pixels has once
// counts as much as the others.
constexpr int kAcross = 2, kAlong = 1;
constexpr float kHalf = 0.5F;

struct Grid {
  int x0 = 0, y0 = 0, width = 0;
  std::vector<std::int32_t> surface;  // of each pixel, with a border; kNone: none

  static constexpr std::int32_t kNone = -1;

  std::size_t number_of(PixelPlace pixel) const {
    return static_cast<std::size_t>(pixel.y - y0 + kAlong) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(pixel.x - x0 + kAcross);
  }
};

void lay_grid(const WaveSurfaces& surfaces, const PixelPlace* pixel, Grid& grid) {
  PixelPlace low = pixel[surfaces.owner[0]], high = low;
  for (std::int64_t i = 1; i < surfaces.count; ++i) {
    const PixelPlace at = pixel[surfaces.owner[i]];
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  grid.x0 = low.x;
  grid.y0 = low.y;
  grid.width = high.x - low.x + 1 + 2 * kAcross;
  const int height = high.y - low.y + 1 + 2 * kAlong;
  grid.surface.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(height), Grid::kNone);
  for (std::int64_t i = 0; i < surfaces.count; ++i)
    grid.surface[grid.number_of(pixel[surfaces.owner[i]])] = static_cast<std::int32_t>(i);
}

}  // namespace

void find_neighbours(const WaveSurfaces& surfaces, const PixelPlace* pixel, Neighbours& neighbours) {
  static thread_local Grid grid;
  neighbours.first.assign(static_cast<std::size_t>(surfaces.count) + 1, 0);
  neighbours.surface.clear();
  neighbours.weight.clear();
  if (surfaces.count == 0) return;
  lay_grid(surfaces, pixel, grid);
  for (std::int64_t i = 0; i < surfaces.count; ++i) {
    const std::int32_t* const middle = grid.surface.data() + grid.number_of(pixel[surfaces.owner[i]]);
    const std::int64_t id = surfaces.id[i];
    for (int dy = -kAlong; dy <= kAlong; ++dy)
      for (int dx = -kAcross; dx <= kAcross; ++dx) {
        const std::int32_t other = middle[dy * grid.width + dx];
        if (other == Grid::kNone || surfaces.id[other] != id) continue;
        neighbours.surface.push_back(other);
        neighbours.weight.push_back((dx == kAcross || dx == -kAcross ? kHalf : 1) *
                                    (dy == kAlong || dy == -kAlong ? kHalf : 1));
      }
    neighbours.first[static_cast<std::size_t>(i) + 1] = static_cast<std::int64_t>(neighbours.surface.size());
  }
}

void share(const Neighbours& neighbours, const double* importance, double* values) {
  static thread_local std::vector<double> shared;
  const auto count = static_cast<std::int64_t>(neighbours.first.size()) - 1;
  shared.resize(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    double sum = 0, all = 0;
    for (std::int64_t at = neighbours.first[static_cast<std::size_t>(i)];
         at < neighbours.first[static_cast<std::size_t>(i) + 1]; ++at) {
      const std::int32_t other = neighbours.surface[static_cast<std::size_t>(at)];
      const double weight =
          double{neighbours.weight[static_cast<std::size_t>(at)]} * (importance != nullptr ? importance[other] : 1);
      sum = sum + weight * values[other];
      all = all + weight;
    }
    shared[static_cast<std::size_t>(i)] = all > 0 ? sum / all : values[i];
  }
  std::copy_n(shared.data(), count, values);
}

}  // namespace bihive::steps
