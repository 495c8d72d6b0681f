// The wide builder keeps its promises on hostile sets: time, memory, and the error when memory is short.
#include "bihive/wide/wide_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "bihive/wide/wide_validate.h"
#include "support/growing_sets.h"
#include "support/hostile_sets.h"
#include "support/thread_time.h"

namespace bihive {
namespace {

using TreePointer = std::shared_ptr<const WideTree>;

TreePointer built(WideBuilder& builder, const SphereSet& spheres, const WideParameters& parameters = {}) {
  Result<TreePointer> tree = builder.build(spheres, parameters);
  EXPECT_TRUE(tree.ok());
  return *tree;
}

// The work of the fastest of three builds on one thread, as this thread's processor time, so that other work on the
// machine does not count.
[[maybe_unused]] double build_ms(const SphereSet& spheres) {
  WideBuilder builder;
  double shortest = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double start = test::thread_time_ms();
    EXPECT_TRUE(builder.build(spheres, {}, 1).ok());
    shortest = std::min(shortest, test::thread_time_ms() - start);
  }
  return shortest;
}

TEST(WideBuilderHostile, RightTreesInTimeThatGrowsAsNLogN) {
  for (const test::GrowingSet& set : test::growing_sets()) {
    const SphereSet few = test::sphere_set(set.make(10000)), many = test::sphere_set(set.make(160000));
    WideBuilder builder;
    for (const SphereSet* spheres : {&few, &many}) {
      const Status status = validate_wide_tree(*built(builder, *spheres), *spheres);
      EXPECT_TRUE(status.ok()) << set.name << ": " << (status.ok() ? "" : status.error().to_string());
    }
    // Sixteen times the spheres: n log n is 21 times the work, n to the power of 1.5 already 64 times. The limit
    // between them leaves room for caches (14 to 32 times were seen beside other work). A neighbour that takes the
    // shared caches away just for the larger set was seen to give 56 times once, so one of five attempts must keep the
    // limit; a builder of the wrong order keeps it in none. Not under a sanitizer: its own memory outgrows the caches.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    double few_ms = 0, many_ms = 0;
    bool kept = false;
    for (int attempt = 0; attempt < 5 && !kept; ++attempt) {
      few_ms = build_ms(few);
      many_ms = build_ms(many);
      kept = many_ms < 50 * few_ms + 5;
    }
    EXPECT_TRUE(kept) << set.name << ": " << few_ms << " ms, then " << many_ms << " ms";
#endif
  }
}

TEST(WideBuilderHostile, PeakMemoryIsBounded) {
  for (const test::GrowingSet& set : test::growing_sets())
    for (const int n : {1, 100, 10000, 160000})
      for (const WideParameters parameters : {WideParameters{}, {1, 0}, {100, 0}, {0, 1}, {0, 3}}) {
        WideBuilder builder;
        const TreePointer tree = built(builder, test::sphere_set(set.make(n)), parameters);
        const WideMemoryPrediction prediction = predict_wide_memory(n, parameters);
        EXPECT_LE(tree->allocated_bytes() + builder.scratch_bytes(), prediction.most_bytes)
            << set.name << ", " << n << " spheres, " << parameters.max_prims << ", " << parameters.max_depth;
      }
}

TEST(WideBuilderHostile, UsedMemoryIsAsPredicted) {
  // Sets as users have them: packed, scattered, clustered, of one radius and of many.
  std::vector<test::World> worlds;
  for (int s = 0; s < 3; ++s)
    for (const int n : {64, 4096, 50000})
      worlds.push_back(test::world_of(*scenario_spheres(static_cast<Scenario>(s + 1), {n, 0.1F, 1}), "scenario"));
  for (const int n : {1, 15, 17, 300, 5000, 100000, 200000}) {
    worlds.push_back(test::random_world("uniform", 5, n, 10, 0.1, 0.1));
    worlds.push_back(test::random_world("many radii", 6, n, 10, 0.01, 0.5));
  }
  for (const test::World& world : worlds)
    for (const WideParameters parameters : {WideParameters{}, {1, 0}, {4, 0}, {100, 0}, {0, 1}, {0, 3}}) {
      WideBuilder builder;
      const TreePointer tree = built(builder, test::sphere_set(world), parameters);
      const WideMemoryPrediction prediction = predict_wide_memory(tree->size, parameters);
      const auto repeated = static_cast<std::int64_t>(tree->repeated.size() * sizeof(RepeatedSphere));
      const std::string what = world.name + ", " + std::to_string(world.size()) + " spheres, " +
                               std::to_string(parameters.max_prims) + ", " + std::to_string(parameters.max_depth);
      EXPECT_GE(tree->used_bytes() - repeated, prediction.low_bytes) << what;
      EXPECT_LE(tree->used_bytes() - repeated, prediction.high_bytes) << what;
      const std::int64_t peak = tree->allocated_bytes() + builder.scratch_bytes();
      EXPECT_LE(peak, prediction.most_bytes) << what;
      if (tree->size >= 50000 && parameters.max_prims == 0 && parameters.max_depth == 0) {
        EXPECT_LE(static_cast<double>(prediction.peak_bytes), 1.5 * static_cast<double>(peak)) << what;
        EXPECT_GE(1.5 * static_cast<double>(prediction.peak_bytes), static_cast<double>(peak)) << what;
      }
    }
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// In a process of its own: it leaves itself 16 MiB, which is too little for either block of arrays (40 MB), and builds.
void run_out_of_memory(const SphereSet& spheres) {
  std::int64_t pages = 0;
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr || std::fscanf(file, "%ld", &pages) != 1) std::_Exit(3);
  const rlim_t limit = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + (std::int64_t{16} << 20));
  const rlimit bound{limit, RLIM_INFINITY};
  if (setrlimit(RLIMIT_AS, &bound) != 0) std::_Exit(4);
  WideBuilder builder;
  const Result<TreePointer> tree = builder.build(spheres, {}, 1);
  if (tree.ok()) std::_Exit(5);
  std::fputs(tree.error().to_string().c_str(), stderr);
  std::_Exit(0);
}

TEST(WideBuilderHostile, TooLittleMemoryIsAnError) {
  const SphereSet spheres = test::sphere_set(test::random_world("random", 9, 2000000, 10, 0.01, 0.02));
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(run_out_of_memory(spheres), testing::ExitedWithCode(0),
              "the tree of 2,000,000 spheres.*the limit of this process");
}
#endif

}  // namespace
}  // namespace bihive
