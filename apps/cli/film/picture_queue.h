// A bounded queue between two threads of a film: the faster one waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "bihive/base/cancel.h"

namespace bihive::cli {

/// Waiting ends once the token is set, which a signal does without waking threads.
template <class T>
class PictureQueue {
 public:
  PictureQueue(std::size_t room, const CancelToken& cancel) : room_(room), cancel_(cancel) {}

  /// False if the queue is closed: the item is then lost.
  bool push(T thing) {
    std::unique_lock<std::mutex> lock(mutex_);
    wait(lock, [this] { return closed_ || things_.size() < room_; });
    if (closed_ || things_.size() >= room_) return false;
    things_.push_back(std::move(thing));
    changed_.notify_all();
    return true;
  }

  /// The next item; nothing after the end.
  std::optional<T> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    wait(lock, [this] { return closed_ || ended_ || !things_.empty(); });
    if (closed_ || things_.empty()) return std::nullopt;
    T thing = std::move(things_.front());
    things_.pop_front();
    changed_.notify_all();
    return thing;
  }

  /// No more items will come; the present ones are still handed out.
  void end() { set(ended_); }
  /// No more items are wanted.
  void close() { set(closed_); }

 private:
  template <class Ready>
  void wait(std::unique_lock<std::mutex>& lock, const Ready& ready) {
    while (!ready() && !cancel_.cancelled()) changed_.wait_for(lock, std::chrono::milliseconds(50));
  }
  void set(bool& flag) {
    const std::lock_guard<std::mutex> lock(mutex_);
    flag = true;
    changed_.notify_all();
  }

  std::size_t room_;
  const CancelToken& cancel_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> things_;
  bool closed_ = false, ended_ = false;
};

}  // namespace bihive::cli
