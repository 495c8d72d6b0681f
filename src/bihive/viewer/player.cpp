#include "bihive/viewer/player.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/check.h"

namespace bihive {

void Player::start_anew(std::int64_t frames, std::int64_t frame) {
  BIHIVE_CHECK(frames >= 1 && frame >= 0 && frame < frames);
  frames_ = frames;
  frame_ = frame;
  shown_ = true;
  playing_ = false;
}

void Player::want(std::int64_t frame) {
  if (frame == frame_) return;
  frame_ = frame;
  shown_ = false;
}

void Player::play(double now_ms) {
  if (frames_ == 1 || playing_) return;
  playing_ = true;
  due_ms_ = now_ms + (shown_ ? period_ms() : 0);
  if (frame_ != frames_ - 1 || loops_) return;
  want(0);
  due_ms_ = now_ms;
}

void Player::step(std::int64_t by) {
  playing_ = false;
  const std::int64_t wanted = frame_ + std::clamp(by, -frames_, frames_);
  want(loops_ ? (wanted % frames_ + frames_) % frames_ : std::clamp<std::int64_t>(wanted, 0, frames_ - 1));
}

void Player::go_to(std::int64_t frame) {
  want(std::clamp<std::int64_t>(frame, 0, frames_ - 1));
}

void Player::set_frames_per_second(double speed) {
  if (!std::isfinite(speed)) return;
  const double before_ms = period_ms();
  frames_per_second_ = std::clamp(speed, kSlowestPlay, kFastestPlay);
  if (playing_ && shown_) due_ms_ += period_ms() - before_ms;
}

void Player::shown(double now_ms) {
  if (shown_) return;
  shown_ = true;
  // Short delays are caught up, long ones are not.
  due_ms_ = std::max(due_ms_ + period_ms(), now_ms);
}

bool Player::advance(double now_ms) {
  if (!playing_ || !shown_ || now_ms < due_ms_) return false;
  if (frame_ == frames_ - 1 && !loops_) {
    playing_ = false;
    return false;
  }
  want((frame_ + 1) % frames_);
  return true;
}

std::optional<double> Player::wait_ms(double now_ms) const {
  if (!playing_ || !shown_) return std::nullopt;
  return std::max(0.0, due_ms_ - now_ms);
}

std::optional<std::int64_t> Player::next() const {
  if (!playing_ || (frame_ == frames_ - 1 && !loops_)) return std::nullopt;
  return (frame_ + 1) % frames_;
}

}  // namespace bihive
