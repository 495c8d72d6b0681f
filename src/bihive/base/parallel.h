// The one place where threads are made: oneTBB natively, a small pool of our own under WebAssembly and ThreadSanitizer.
#pragma once

#include <cstdint>
#include <functional>

namespace bihive {

/// The number of threads this machine runs at once, at least 1.
int hardware_threads();

/// Calls body(i) once for each 0 <= i < count, on at most `threads` threads (0 = hardware_threads()), in any order, and
/// returns when all calls have. Whatever the body writes must depend on i alone, so that the thread count cannot show.
/// The body must not throw.
void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body);

/// Where a running task leaves further tasks.
class TaskList {
 public:
  /// Runs `task` now or later, on this thread or another. Any thread that runs a task of this list may call it.
  virtual void add(std::function<void()> task) = 0;

 protected:
  ~TaskList() = default;
};

/// Runs `first` and every task that it and they add, on at most `threads` threads (0 = hardware_threads()), in any
/// order, and returns when all are done. With one thread each task runs where it is added. The rules of parallel_for
/// hold.
void parallel_tasks(int threads, const std::function<void(TaskList&)>& first);

}  // namespace bihive
