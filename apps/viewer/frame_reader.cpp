#include "frame_reader.h"

#include <algorithm>
#include <utility>

namespace bihive::window {

FrameReader::FrameReader(std::shared_ptr<const Frames> frames, std::function<void()> on_ready)
    : frames_(std::move(frames)), on_ready_(std::move(on_ready)), thread_([this] { run(); }) {}

FrameReader::~FrameReader() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void FrameReader::want(std::int64_t frame, std::optional<std::int64_t> ahead, std::shared_ptr<const FrameMaker> maker) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (maker != maker_) came_.clear();
    maker_ = std::move(maker);
    wanted_ = {frame};
    if (ahead && *ahead != frame) wanted_.push_back(*ahead);
    came_.erase(std::remove_if(came_.begin(), came_.end(),
                               [this](const Came& came) {
                                 return std::find(wanted_.begin(), wanted_.end(), came.frame) == wanted_.end();
                               }),
                came_.end());
  }
  changed_.notify_one();
}

std::optional<Result<std::shared_ptr<PreparedFrame>>> FrameReader::take(std::int64_t frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto came = came_.begin(); came != came_.end(); ++came) {
    if (came->frame != frame) continue;
    Result<std::shared_ptr<PreparedFrame>> result = std::move(came->result);
    came_.erase(came);
    wanted_.erase(std::remove(wanted_.begin(), wanted_.end(), frame), wanted_.end());
    return result;
  }
  return std::nullopt;
}

// The first requested frame that is missing; the caller holds the mutex.
std::optional<std::int64_t> FrameReader::missing() const {
  for (const std::int64_t frame : wanted_)
    if (std::none_of(came_.begin(), came_.end(), [frame](const Came& came) { return came.frame == frame; }))
      return frame;
  return std::nullopt;
}

void FrameReader::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || missing(); });
    if (ends_) return;
    const std::int64_t frame = *missing();
    const std::shared_ptr<const FrameMaker> maker = maker_;

    // Read it and build its trees, while other threads continue.
    lock.unlock();
    Result<SphereFile> read = frames_->read(frame);
    Result<std::shared_ptr<PreparedFrame>> made =
        read ? maker->make(std::move(*read)) : Result<std::shared_ptr<PreparedFrame>>(read.error());
    lock.lock();

    // It may no longer be needed.
    const bool is_wanted = std::find(wanted_.begin(), wanted_.end(), frame) != wanted_.end();
    if (maker != maker_ || !is_wanted) continue;
    came_.push_back({frame, std::move(made)});
    lock.unlock();
    on_ready_();
    lock.lock();
  }
}

}  // namespace bihive::window
