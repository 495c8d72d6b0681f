#include "bihive/render/picture_tiles.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/check.h"

namespace bihive {
namespace {

constexpr int kOfEach = 8;  // tiles for each who draws

// The renderer's own tiles have this width.
constexpr int kTileStepPx = 64;
constexpr int kLeastRows = 16, kMostRows = 64;

int in_steps(int all, int step) {
  return (all + step - 1) / step;
}

}  // namespace

PictureTiles::PictureTiles(const RenderSettings& settings, int who_draw) : all_(drawn_pixels(settings)) {
  BIHIVE_CHECK_GE(who_draw, 1);
  // As near to squares as the largest height allows: their rays meet fewer spheres than those of long rows.
  const double pixels = static_cast<double>(all_.width()) * all_.height();
  const double area = pixels / kOfEach / who_draw;
  height_ = std::clamp(static_cast<int>(std::sqrt(area)), kLeastRows, kMostRows);
  const double width = std::clamp(area / height_, 1.0, static_cast<double>(all_.width()));
  width_ = in_steps(static_cast<int>(width), kTileStepPx) * kTileStepPx;
  columns_ = in_steps(all_.width(), width_);
  rows_ = in_steps(all_.height(), height_);
}

Tile PictureTiles::pixels(std::int64_t number) const {
  Tile tile = pixels_of_row(static_cast<int>(number / columns_));
  tile.x0 = all_.x0 + static_cast<int>(number % columns_) * width_;
  tile.x1 = std::min(tile.x0 + width_, all_.x1);
  return tile;
}

Tile PictureTiles::pixels_of_row(int row) const {
  const int y = all_.y0 + row * height_;
  return {all_.x0, y, all_.x1, std::min(y + height_, all_.y1)};
}

}  // namespace bihive
