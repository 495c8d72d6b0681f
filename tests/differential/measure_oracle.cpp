// Measures of small sets of spheres against arithmetic of 384 bits (tests/support/measure_reference.h).
//
//   measure_oracle [--sets N] [--seed N] [--most N] [--threads N]
//
// Half of the sets are hostile: spheres that touch, share circles, are equal or nested, lattices, four and more through
// a point. The others are random, of radii up to four octaves,
// and from eight spheres on some enclose a hollow or nearly so. Each has up to `most` spheres (6, at most 14). Every
// sphere's solid angle and vector area, and the area and volume of the union, must lie within the bounds that the
// library states; connected parts and cavities must be the same. Prints each set that differs, and fails.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>

#include "bihive/base/parallel.h"
#include "support/hostile_balls.h"
#include "support/measure_differences.h"

namespace bihive::test {
namespace {

constexpr std::int64_t kSetsAtOnce = 64;
constexpr int kMostShown = 10;

struct Options {
  std::int64_t sets = 20000;
  std::uint64_t seed = 1;
  int most = 6, threads = 0;
};

[[noreturn]] void fail_usage() {
  std::fprintf(stderr, "usage: measure_oracle [--sets N] [--seed N] [--most 2..14] [--threads N]\n");
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    const std::int64_t value = std::atoll(argv[i + 1]);
    if (name == "--sets")
      options.sets = value;
    else if (name == "--seed")
      options.seed = static_cast<std::uint64_t>(value);
    else if (name == "--most")
      options.most = static_cast<int>(value);
    else if (name == "--threads")
      options.threads = static_cast<int>(value);
    else
      fail_usage();
  }
  if (argc % 2 == 0 || options.sets < 1 || options.most < 2 || options.most > kMostReferenceBalls) fail_usage();
  return options;
}

measure::Balls set_number(const Options& options, std::int64_t number) {
  SplitMix64 rng(options.seed * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(number));
  rng.next_double();
  const auto kind = static_cast<int>(number % 8);
  if (number % 64 == 63 && options.most >= 8) return enclosing_balls(rng);
  if (kind >= 4) return random_balls(rng, 2 + static_cast<int>((options.most - 1) * rng.next_double()), 1 + kind % 4);
  measure::Balls balls = hostile_balls(rng, kind);
  balls.centre.resize(std::min(balls.centre.size(), static_cast<std::size_t>(options.most)));
  balls.radius.resize(balls.centre.size());
  return balls;
}

int run(const Options& options) {
  std::atomic<std::int64_t> wrong = 0, undecided = 0;
  std::mutex output;
  parallel_for(options.threads, (options.sets + kSetsAtOnce - 1) / kSetsAtOnce, [&](std::int64_t part) {
    const std::int64_t end = std::min(options.sets, (part + 1) * kSetsAtOnce);
    for (std::int64_t number = part * kSetsAtOnce; number < end; ++number) {
      const measure::Balls balls = set_number(options, number);
      if (small_union(balls).undecided_spheres > 0) ++undecided;
      const std::string differences = measure_differences(balls, true);
      if (differences.empty()) continue;
      const std::lock_guard lock(output);
      if (++wrong <= kMostShown)
        std::printf("set %lld: %s\n%s", static_cast<long long>(number), differences.c_str(),
                    text_of_balls(balls).c_str());
    }
  });
  std::printf("%lld sets of up to %d spheres, seed %llu: %lld differ, %lld with pieces that could not be told apart\n",
              static_cast<long long>(options.sets), options.most, static_cast<unsigned long long>(options.seed),
              static_cast<long long>(wrong.load()), static_cast<long long>(undecided.load()));
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace bihive::test

int main(int argc, char** argv) {
  return bihive::test::run(bihive::test::parse(argc, argv));
}
