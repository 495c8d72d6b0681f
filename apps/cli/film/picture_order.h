// The order in which a film shows its pictures: each is drawn once, and may be shown several times.
#pragma once

#include <algorithm>
#include <cstdint>

namespace bihive::cli {

/// Forwards or backwards through all pictures; the first and the last one of these may be held; then back to the
/// beginning, without showing the ends again. `pictures`: how many are drawn, at least one. Positions count from 0.
struct PictureOrder {
  std::int64_t hold_first = 0, hold_last = 0;  ///< further times that an end is shown
  bool reverse = false;
  bool ping_pong = false;

  bool is_plain() const { return hold_first == 0 && hold_last == 0 && !reverse && !ping_pong; }

  /// The positions before the way back.
  std::int64_t positions_forth(std::int64_t pictures) const { return hold_first + pictures + hold_last; }
  /// All positions.
  std::int64_t positions(std::int64_t pictures) const {
    return positions_forth(pictures) + (ping_pong ? std::max<std::int64_t>(0, pictures - 2) : 0);
  }

  /// The picture at a position.
  std::int64_t picture_at(std::int64_t position, std::int64_t pictures) const {
    const std::int64_t step = step_at(position, pictures);
    return reverse ? pictures - 1 - step : step;
  }
  /// The first position that shows the same picture.
  std::int64_t first_position(std::int64_t position, std::int64_t pictures) const {
    const std::int64_t step = step_at(position, pictures);
    return step == 0 ? 0 : hold_first + step;
  }

 private:
  // The number of the picture on the way forth.
  std::int64_t step_at(std::int64_t position, std::int64_t pictures) const {
    const std::int64_t back = position - positions_forth(pictures);
    if (back >= 0) return pictures - 2 - back;
    return std::clamp<std::int64_t>(position - hold_first, 0, pictures - 1);
  }
};

}  // namespace bihive::cli
