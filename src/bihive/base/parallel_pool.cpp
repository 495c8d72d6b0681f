// parallel_for and parallel_tasks on std::thread, for builds where oneTBB cannot be used.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"

namespace bihive {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
constexpr bool kHasThreads = false;
#else
constexpr bool kHasThreads = true;
#endif

namespace {

// Runs each task at the point where it is added.
class Inline final : public TaskList {
 public:
  void add(std::function<void()> task) override { task(); }
};

// Tasks that wait for a thread. The thread takes the latest task first.
class Waiting final : public TaskList {
 public:
  void add(std::function<void()> task) override {
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    changed_.notify_one();
  }

  // Runs tasks until none is waiting and no running task could add one.
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return !tasks_.empty() || running_ == 0; });
      if (tasks_.empty()) break;
      const std::function<void()> task = std::move(tasks_.back());
      tasks_.pop_back();
      ++running_;
      lock.unlock();
      task();
      lock.lock();
      --running_;
    }
    lock.unlock();
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::function<void()>> tasks_;
  int running_ = 0;
};

// Whether this thread runs the body of a call. Calls inside it create no thread: a browser starts a thread that a
// helper asks for only when the module's first thread is idle, and that one waits for the helper.
thread_local bool is_inside_a_call = false;

// Calls work() on that many threads, including this one.
template <class Work>
void on_threads(std::int64_t threads, const Work& work) {
  const auto inside = [&work] {
    is_inside_a_call = true;
    work();
    is_inside_a_call = false;
  };
  std::vector<std::thread> helpers;
  try {
    for (std::int64_t k = 1; k < threads; ++k) helpers.emplace_back(inside);
  } catch (const std::exception&) {
    // The system is out of threads or memory: the threads created so far do the work.
  }
  inside();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace

int hardware_threads() {
  return kHasThreads ? std::max(1, static_cast<int>(std::thread::hardware_concurrency())) : 1;
}

void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body) {
  const Unwatched unwatched;
  if (threads == 0) threads = hardware_threads();
  if (!kHasThreads || is_inside_a_call || threads == 1 || count <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Every thread, including this one, takes the next index until none is left.
  std::atomic<std::int64_t> next{0};
  const auto work = [&] {
    for (std::int64_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) body(i);
  };
  on_threads(std::min<std::int64_t>(threads, count), work);
}

void parallel_tasks(int threads, const std::function<void(TaskList&)>& first) {
  const Unwatched unwatched;
  if (threads == 0) threads = hardware_threads();
  if (!kHasThreads || is_inside_a_call || threads == 1) {
    Inline list;
    first(list);
    return;
  }
  Waiting list;
  list.add([&] { first(list); });
  on_threads(threads, [&] { list.work(); });
}

}  // namespace bihive
