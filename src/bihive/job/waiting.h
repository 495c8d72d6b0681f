// Long work on a thread of its own, while the calling thread looks after it: for callers in other languages, whose
// functions may be called on their own threads alone.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "bihive/base/cancel.h"
#include "bihive/base/watch.h"

namespace bihive {

/// Shared by the work and the thread that waits for it.
struct Work {
  CancelToken cancel;           ///< set: stop soon; the result is no longer needed
  std::atomic<double> done{0};  ///< the finished share, 0 to 1

  /// Puts the share that a call has finished between these two of the whole work.
  ProgressCallback between(double begin, double end) {
    return [this, begin, end](double share) { done.store(begin + (end - begin) * share, std::memory_order_relaxed); };
  }
};

constexpr std::chrono::milliseconds kBetweenLooks(50);

/// Calls work(Work&), which may throw, on a thread of its own. The calls watched there (base/watch.h) obey
/// Work::cancel. Until it ends, this thread calls look(done) every 50 ms; once that returns false, the work is
/// cancelled. An exception of the work is thrown here. Throws std::system_error if there is no thread.
template <class DoWork, class Look>
void wait_for_work(const DoWork& work, const Look& look) {
  Work shared;
  std::mutex mutex;
  std::condition_variable changed;
  bool finished = false;
  std::exception_ptr thrown;
  std::thread worker([&] {
    try {
      const Watch watch({}, &shared.cancel);
      work(shared);
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::lock_guard<std::mutex> guard(mutex);
    finished = true;
    changed.notify_one();
  });
  while (true) {
    {
      std::unique_lock<std::mutex> guard(mutex);
      if (changed.wait_for(guard, kBetweenLooks, [&] { return finished; })) break;
    }
    if (!shared.cancel.cancelled() && !look(shared.done.load(std::memory_order_relaxed))) shared.cancel.cancel();
  }
  worker.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace bihive
