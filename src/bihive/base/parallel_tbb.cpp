// parallel_for and parallel_tasks on oneTBB.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <pthread.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"

namespace bihive {
namespace {

// Runs each task at the point where it is added.
class Inline final : public TaskList {
 public:
  void add(std::function<void()> task) override { task(); }
};

class Group final : public TaskList {
 public:
  void add(std::function<void()> task) override { group_.run(std::move(task)); }
  void wait() { group_.wait(); }

 private:
  oneapi::tbb::task_group group_;
};

// Counts how many threads can be created beside this one, up to `wanted`, by creating and joining them: if the system
// has no more, oneTBB itself throws on a thread where nobody catches it. A thread of the C++ library takes twice the
// stack of one of oneTBB's, so memory is left for the work.
int threads_beside(int wanted) {
  std::mutex gate;
  std::vector<std::thread> threads;
  std::unique_lock<std::mutex> closed(gate);
  try {
    threads.reserve(static_cast<std::size_t>(wanted));
    while (static_cast<int>(threads.size()) < wanted)
      threads.emplace_back([&gate] { const std::lock_guard<std::mutex> wait(gate); });
  } catch (const std::exception&) {
    // Out of threads or memory: those created so far count.
  }
  const auto made = static_cast<int>(threads.size());
  closed.unlock();
  for (std::thread& thread : threads) thread.join();
  return made;
}

// The number of threads requested, or that the system can create. It is probed once for each larger number.
int threads_to_use(int wanted) {
  static std::mutex mutex;
  static int asked = 1, made = 1;
  const std::lock_guard<std::mutex> lock(mutex);
  if (wanted > asked && made == asked) {
    made = 1 + threads_beside(wanted - 1);
    asked = wanted;
  }
  return std::min(wanted, made);
}

// Idle arenas, which later calls take again. oneTBB frees an arena only after a worker has looked into it, and on a
// busy machine workers come late: an arena for each call would grow memory by 7 kB per call. A call takes an arena for
// itself, so nested and concurrent calls keep their number of threads.
class Arenas {
 public:
  using Arena = std::unique_ptr<oneapi::tbb::task_arena>;

  // Never destroyed: other threads may still use it when the program ends.
  static Arenas& all() {
    static auto* const arenas = new Arenas;
    return *arenas;
  }

  Arena take(int threads) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (Arena& arena : idle_)
        if (arena->max_concurrency() == threads) {
          std::swap(arena, idle_.back());
          Arena taken = std::move(idle_.back());
          idle_.pop_back();
          return taken;
        }
    }
    return std::make_unique<oneapi::tbb::task_arena>(threads);
  }

  // Keeps the arena unless there are plenty.
  void give_back(Arena arena) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (idle_.size() < kMostIdle) idle_.push_back(std::move(arena));
  }

 private:
  static constexpr std::size_t kMostIdle = 64;

  Arenas() {
    idle_.reserve(kMostIdle);
    // A forked child must not find the list locked by a thread that it does not have.
    pthread_atfork([] { all().mutex_.lock(); }, [] { all().mutex_.unlock(); }, [] { all().mutex_.unlock(); });
  }

  std::mutex mutex_;
  std::vector<Arena> idle_;
};

// Calls body() in an arena of that many threads.
template <class Body>
void in_arena(int threads, const Body& body) {
  // Raise oneTBB's limit if the caller wants more threads than the machine runs at once.
  std::optional<oneapi::tbb::global_control> limit;
  if (threads > hardware_threads())
    limit.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  Arenas::Arena arena = Arenas::all().take(threads);
  arena->execute(body);
  Arenas::all().give_back(std::move(arena));
}

}  // namespace

int hardware_threads() {
  return std::max(1, oneapi::tbb::info::default_concurrency());
}

void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body) {
  const Unwatched unwatched;
  threads = threads_to_use(threads == 0 ? hardware_threads() : threads);
  // One thread runs a plain loop, so it needs no scheduler.
  if (threads == 1 || count <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  in_arena(threads,
           [&] { oneapi::tbb::parallel_for(std::int64_t{0}, count, body, oneapi::tbb::simple_partitioner()); });
}

void parallel_tasks(int threads, const std::function<void(TaskList&)>& first) {
  const Unwatched unwatched;
  threads = threads_to_use(threads == 0 ? hardware_threads() : threads);
  if (threads == 1) {
    Inline list;
    first(list);
    return;
  }
  in_arena(threads, [&] {
    Group list;
    first(list);
    list.wait();
  });
}

}  // namespace bihive
