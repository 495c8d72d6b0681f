// parallel_for: every index once, with any number of threads. parallel_tasks: every task.
// ctest: threads
#include "bihive/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <iterator>
#include <thread>
#include <vector>

namespace bihive {
namespace {

TEST(Parallel, EveryIndexOnce) {
  for (const int threads : {0, 1, 2, 3, 8}) {
    for (const std::int64_t count : {0, 1, 2, 7, 1000}) {
      std::vector<int> calls(static_cast<std::size_t>(count), 0);
      parallel_for(threads, count, [&](std::int64_t i) { ++calls[static_cast<std::size_t>(i)]; });
      EXPECT_EQ(calls, std::vector<int>(static_cast<std::size_t>(count), 1)) << threads << " threads, " << count;
    }
  }
}

TEST(Parallel, WhatTheBodyWroteIsSeenAfterwards) {
  std::vector<double> squares(10000);
  parallel_for(4, std::ssize(squares), [&](std::int64_t i) { squares[static_cast<std::size_t>(i)] = double(i * i); });
  double sum = 0;
  for (const double square : squares) sum += square;
  EXPECT_EQ(sum, 10000.0 * 9999 * 19999 / 6);
}

TEST(Parallel, NeverMoreThreadsThanAsked) {
  for (const int threads : {1, 2, 3}) {
    std::atomic<int> inside{0}, most{0};
    parallel_for(threads, 64, [&](std::int64_t) {
      const int now = ++inside;
      for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
      std::this_thread::yield();
      --inside;
    });
    EXPECT_GE(most, 1);
    EXPECT_LE(most, threads);
  }
}

TEST(Parallel, SeveralThreadsMayCallAtOnce) {
  std::atomic<int> sum{0};
  std::thread other([&] { parallel_for(2, 100, [&](std::int64_t) { ++sum; }); });
  parallel_for(2, 100, [&](std::int64_t) { ++sum; });
  other.join();
  EXPECT_EQ(sum, 200);
}

// Adds two tasks at each level; counts the tasks.
void add_tree(TaskList& list, int levels, std::atomic<int>& tasks) {
  ++tasks;
  for (int k = 0; levels > 0 && k < 2; ++k) list.add([&list, &tasks, levels] { add_tree(list, levels - 1, tasks); });
}

TEST(Parallel, EveryTaskThatATaskAdds) {
  for (const int threads : {0, 1, 2, 5}) {
    std::atomic<int> tasks{0};
    parallel_tasks(threads, [&](TaskList& list) { add_tree(list, 9, tasks); });
    EXPECT_EQ(tasks, 1023) << threads;
    parallel_tasks(threads, [](TaskList&) {});
  }
}

TEST(Parallel, NeverMoreTasksAtOnceThanThreads) {
  for (const int threads : {1, 2, 3}) {
    std::atomic<int> inside{0}, most{0};
    parallel_tasks(threads, [&](TaskList& list) {
      for (int k = 0; k < 50; ++k)
        list.add([&] {
          const int now = ++inside;
          for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
          std::this_thread::yield();
          --inside;
        });
    });
    EXPECT_GE(most, 1);
    EXPECT_LE(most, threads);
  }
}

TEST(Parallel, TheMachineHasThreads) {
  EXPECT_GE(hardware_threads(), 1);
}

}  // namespace
}  // namespace bihive
