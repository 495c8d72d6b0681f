// parallel_for and parallel_tasks on oneTBB.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bihive/base/parallel.h"

namespace bihive {
namespace {

// Runs each task at the place where it is added.
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

// Calls body() in an arena of that many threads.
template <class Body>
void in_arena(int threads, const Body& body) {
  // Raise oneTBB's limit if the caller wants more threads than the machine runs at once.
  std::optional<oneapi::tbb::global_control> limit;
  if (threads > hardware_threads())
    limit.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  oneapi::tbb::task_arena arena(threads);
  arena.execute(body);
}

}  // namespace

int hardware_threads() {
  return std::max(1, oneapi::tbb::info::default_concurrency());
}

void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body) {
  if (threads == 0) threads = hardware_threads();
  // One thread runs a plain loop, so it needs no scheduler.
  if (threads == 1 || count <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  in_arena(threads,
           [&] { oneapi::tbb::parallel_for(std::int64_t{0}, count, body, oneapi::tbb::simple_partitioner()); });
}

void parallel_tasks(int threads, const std::function<void(TaskList&)>& first) {
  if (threads == 0) threads = hardware_threads();
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
