// parallel_for on std::thread, for builds where oneTBB cannot be used.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "bihive/base/parallel.h"

namespace bihive {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
constexpr bool kHasThreads = false;
#else
constexpr bool kHasThreads = true;
#endif

int hardware_threads() {
  return kHasThreads ? std::max(1, static_cast<int>(std::thread::hardware_concurrency())) : 1;
}

void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body) {
  if (threads == 0) threads = hardware_threads();
  if (!kHasThreads || threads == 1 || count <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Every thread, this one too, takes the next index until none is left.
  std::atomic<std::int64_t> next{0};
  const auto work = [&] {
    for (std::int64_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) body(i);
  };
  std::vector<std::thread> helpers;
  const std::int64_t helper_count = std::min<std::int64_t>(threads, count) - 1;
  for (std::int64_t k = 0; k < helper_count; ++k) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace bihive
