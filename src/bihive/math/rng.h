// splitmix64: the project's only random number generator, the same on every compiler [Steele2014].
#pragma once

#include <cstdint>

namespace bihive {

class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), a multiple of 2^-24: exact in binary32.
  float next_float() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double next_double() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Uniform in 0 ... count - 1 (count > 0), up to a bias of count / 2^64.
  std::uint64_t next_below(std::uint64_t count) { return next() % count; }

 private:
  std::uint64_t state_;
};

}  // namespace bihive
