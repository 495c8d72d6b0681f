// A flag by which one thread (or a signal handler) asks long work to stop soon.
#pragma once

#include <atomic>

namespace bihive {

class CancelToken {
 public:
  /// Safe from any thread and from a signal handler.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
};

}  // namespace bihive
