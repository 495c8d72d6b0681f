// The order in which a pass is drawn: blocks of pixels row by row, as many in one draw as take a wanted time.
#pragma once

#include <algorithm>

#include "bihive/image/film.h"

namespace bihive {

/// Learns from draw to draw how long a block takes, and keeps that from pass to pass and from picture to picture.
class TileWalk {
 public:
  static constexpr int kBlockPx = 32;

  /// Starts at the first block of a picture.
  void restart(int width_px, int height_px) {
    width_ = width_px;
    height_ = height_px;
    columns_ = (width_px + kBlockPx - 1) / kBlockPx;
    rows_ = (height_px + kBlockPx - 1) / kBlockPx;
    next_ = 0;
  }

  bool at_start() const { return next_ == 0; }
  bool at_end() const { return next_ >= columns_ * rows_; }
  /// Share of the pass that is done.
  double done() const { return double(next_) / (double(columns_) * rows_); }

  /// The next tile: some blocks of one row, or whole rows. It should take about `wanted_ms`.
  Tile next(double wanted_ms) {
    // At most four times as many as the last time: behind an empty sky may come what takes seconds.
    planned_ = block_ms_ > 0 ? std::min({wanted_ms / block_ms_, 4 * planned_, 1e6}) : kFirstBlocks;
    const int column = next_ % columns_, row = next_ / columns_;
    planned_ = std::max(planned_, 1.0);
    int count = static_cast<int>(planned_);
    int y1 = row + 1;
    if (column > 0 || count < columns_) {
      count = std::min(count, columns_ - column);
    } else {
      y1 = std::min(row + count / columns_, rows_);
      count = columns_;
    }
    drawn_ = count * (y1 - row);
    next_ += drawn_;
    return {column * kBlockPx, row * kBlockPx, std::min((column + count) * kBlockPx, width_),
            std::min(y1 * kBlockPx, height_)};
  }

  /// How long the last tile took. One that was cheaper than those before is believed by half only.
  void took(double ms) {
    const double now = std::max(ms, 1e-3) / std::max(drawn_, 1);
    block_ms_ = now > block_ms_ ? now : 0.5 * (block_ms_ + now);
  }

 private:
  static constexpr double kFirstBlocks = 2;

  int width_ = 0, height_ = 0, columns_ = 1, rows_ = 0;
  int next_ = 0, drawn_ = 0;
  double block_ms_ = 0, planned_ = kFirstBlocks;
};

}  // namespace bihive
