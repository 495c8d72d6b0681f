// The amount of work of the kernels' tests, and their instruction sets. Slow machines and emulators take fewer rays.
//
// In the environment:
//   BIHIVE_TEST_SHARE=N    one N-th of the work (1 to 64; default 1, with a sanitizer 16): N up to 16 takes fewer rays,
//                          a larger N also fewer sets of spheres
//   BIHIVE_TARGET=NAME     queries on that instruction set alone (default: on all of the machine)
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "bihive/simd/target.h"

namespace bihive::test {

/// N: a test does one N-th of its work, roughly.
inline std::int64_t test_share() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::int64_t kUsual = 16;  // a sanitizer is slower by about this factor
#else
  constexpr std::int64_t kUsual = 1;
#endif
  static const std::int64_t share = [] {
    const char* const number = std::getenv("BIHIVE_TEST_SHARE");
    return number == nullptr ? kUsual : std::clamp<std::int64_t>(std::atoll(number), 1, 64);
  }();
  return share;
}

/// N: a test takes one N-th of its rays.
inline std::int64_t ray_share() {
  return std::min<std::int64_t>(test_share(), 16);
}

/// `usual` rounds, fewer where a test takes a share of its rays, but at least `least`.
inline int at_least(int least, int usual) {
  return std::max(least, static_cast<int>(usual / ray_share()));
}

/// Whether a test takes this one of its sets, numbered from 0.
inline bool takes_set(std::int64_t number) {
  return number % std::max<std::int64_t>(1, test_share() / 16) == 0;
}

/// Those to try each question on. A name in the environment that the machine does not have fails in use_target().
inline std::vector<std::string> targets_under_test() {
  static const std::vector<std::string> targets = [] {
    const char* const name = std::getenv("BIHIVE_TARGET");
    return name == nullptr ? available_targets() : std::vector<std::string>{name};
  }();
  return targets;
}

}  // namespace bihive::test
