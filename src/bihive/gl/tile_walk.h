// The order in which a pass is drawn: blocks of pixels row by row. One draw takes as many blocks as fill a wanted time.
#pragma once

#include <algorithm>

#include "bihive/image/film.h"

namespace bihive {

/// Estimates from draw to draw the time per block, and the fixed time per draw. Keeps both from pass to pass and from
/// picture to picture.
class TileWalk {
 public:
  static constexpr int kBlockPx = 32;

  /// Starts at the first block of a picture. Smaller blocks are for slow pixels.
  void restart(int width_px, int height_px, int block_px = kBlockPx) {
    // A block's time is proportional to its area.
    block_ms_ *= double(block_px) * block_px / (double(block_px_) * block_px_);
    block_px_ = block_px;
    width_ = width_px;
    height_ = height_px;
    columns_ = (width_px + block_px - 1) / block_px;
    rows_ = (height_px + block_px - 1) / block_px;
    next_ = 0;
  }

  bool at_start() const { return next_ == 0; }
  bool at_end() const { return next_ >= columns_ * rows_; }
  /// The finished share of the pass.
  double done() const { return double(next_) / (double(columns_) * rows_); }

  /// The next tile: some blocks of one row, or whole rows. It should take about `wanted_ms`.
  Tile next(double wanted_ms) {
    // The fixed time of a draw pays off if the blocks take as long, or the whole wanted time.
    const double work_ms = std::max(wanted_ms - fixed_ms_, std::min(fixed_ms_, wanted_ms));
    // At most four times as many blocks as last time: blocks after an empty sky may take seconds.
    planned_ = block_ms_ > 0 ? std::min({work_ms / block_ms_, 4 * planned_, 1e6}) : kFirstBlocks;
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
    return {column * block_px_, row * block_px_, std::min((column + count) * block_px_, width_),
            std::min(y1 * block_px_, height_)};
  }

  /// The time of the last tile. If its blocks were cheaper than those before, only half of the difference counts.
  void took(double ms) {
    // A draw takes at least as long as the fastest recent ones. Most of that time may be fixed, spent waiting for the
    // GPU.
    const double most_fixed_ms = kMostFixed * std::max(ms, 1e-3);
    fixed_ms_ = block_ms_ > 0 ? std::min(kForget * fixed_ms_, most_fixed_ms) : most_fixed_ms;
    const double now = (std::max(ms, 1e-3) - fixed_ms_) / std::max(drawn_, 1);
    block_ms_ = now > block_ms_ ? now : 0.5 * (block_ms_ + now);
  }

 private:
  static constexpr double kFirstBlocks = 2;
  static constexpr double kMostFixed = 0.75, kForget = 1.02;

  int block_px_ = kBlockPx;
  int width_ = 0, height_ = 0, columns_ = 1, rows_ = 0;
  int next_ = 0, drawn_ = 0;
  double fixed_ms_ = 0, block_ms_ = 0, planned_ = kFirstBlocks;
};

}  // namespace bihive
