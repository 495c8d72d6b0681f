// parallel_for on oneTBB.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "bihive/base/parallel.h"

namespace bihive {

int hardware_threads() {
  return std::max(1, oneapi::tbb::info::default_concurrency());
}

void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body) {
  if (threads == 0) threads = hardware_threads();
  // One thread: a plain loop, so that a single-threaded run involves no scheduler at all.
  if (threads == 1 || count <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Raise oneTBB's limit where more threads are asked for than the machine runs at once.
  std::optional<oneapi::tbb::global_control> limit;
  if (threads > hardware_threads())
    limit.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  oneapi::tbb::task_arena arena(threads);
  arena.execute([&] { oneapi::tbb::parallel_for(std::int64_t{0}, count, body, oneapi::tbb::simple_partitioner()); });
}

}  // namespace bihive
