// The only code that creates threads: oneTBB natively, a small pool of our own under WebAssembly and ThreadSanitizer.
#pragma once

#include <cstdint>
#include <functional>

namespace bihive {

/// The number of threads this machine runs at once, at least 1.
int hardware_threads();

/// Calls body(i) once for each 0 <= i < count, on at most `threads` threads (0 = hardware_threads()), in any order, and
/// returns after all calls. If the system cannot create that many threads, fewer are used. The output of the body must
/// depend on i alone, so that the number of threads cannot change it. The body must not throw. It may call parallel_for
/// and parallel_tasks; the own pool runs such a call on the calling thread alone, so parallel_tasks() splits work
/// better.
void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body);

/// A running task adds further tasks here.
class TaskList {
 public:
  /// Runs `task` now or later, on this thread or another. Any thread that runs a task of this list may call it.
  virtual void add(std::function<void()> task) = 0;

 protected:
  ~TaskList() = default;
};

/// Runs `first` and all tasks that are added, on at most `threads` threads (0 = hardware_threads()), in any order, and
/// returns when all are done. With one thread a task runs at the point where it is added. The rules of parallel_for
/// hold.
void parallel_tasks(int threads, const std::function<void(TaskList&)>& first);

}  // namespace bihive
