// The own pool, which builds without oneTBB use: calls within calls create no thread.
// ctest: threads
// ctest: alone
#define bihive bihive_own_pool  // tests/CMakeLists.txt compiles it under this name
#include "bihive/base/parallel.h"
#undef bihive

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace bihive_own_pool {
namespace {

// The threads that call note().
class Threads {
 public:
  void note() {
    const std::lock_guard lock(mutex_);
    ids_.insert(std::this_thread::get_id());
  }
  std::size_t count() const { return ids_.size(); }

 private:
  std::mutex mutex_;
  std::set<std::thread::id> ids_;
};

// Under WebAssembly a helper's new thread starts only when the module's first thread is idle, and that one waits for
// the helper: both would wait forever.
TEST(OwnPool, CallsWithinCallsCreateNoThread) {
  for (const int threads : {2, 3}) {
    std::vector<std::atomic<int>> calls(8 * 5 * 7);
    Threads seen;
    parallel_for(threads, 8, [&](std::int64_t i) {
      parallel_for(4, 5, [&](std::int64_t j) {
        parallel_tasks(0, [&](TaskList& list) {
          for (std::int64_t k = 0; k < 7; ++k)
            list.add([&, k] {
              seen.note();
              ++calls[static_cast<std::size_t>((i * 5 + j) * 7 + k)];
            });
        });
      });
    });
    EXPECT_LE(seen.count(), static_cast<std::size_t>(threads));
    for (const std::atomic<int>& one : calls) EXPECT_EQ(one, 1);
  }
}

TEST(OwnPool, CallsWithinTasksCreateNoThread) {
  std::atomic<int> calls{0};
  Threads seen;
  parallel_tasks(2, [&](TaskList& list) {
    for (int k = 0; k < 20; ++k)
      list.add([&] {
        parallel_for(8, 10, [&](std::int64_t) {
          seen.note();
          ++calls;
        });
      });
  });
  EXPECT_EQ(calls, 200);
  EXPECT_LE(seen.count(), 2U);
}

TEST(OwnPool, ALaterCallHasItsThreadsAgain) {
  parallel_for(2, 2, [](std::int64_t) { parallel_for(2, 2, [](std::int64_t) {}); });
  // Both bodies wait until both have begun.
  std::atomic<int> begun{0};
  parallel_for(2, 2, [&](std::int64_t) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  });
  EXPECT_EQ(begun, 2);
}

}  // namespace
}  // namespace bihive_own_pool
