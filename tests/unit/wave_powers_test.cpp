// The vector form of powers against the scalar ones, on every instruction set.
// ctest: inlined
// ctest: kernel
// ctest: asan-long
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "bihive/math/elementary.h"
#include "bihive/math/rng.h"
#include "bihive/simd/target.h"
#include "support/effort.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "unit/wave_powers_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/shade/wave/powers-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// Counts of multiples of 16.
void powers_on_target(const double* x, const double* y, std::size_t count, double* powers) {
  for (std::size_t i = 0; i < count; i += kLanes)
    hn::StoreU(pow_of(first_lanes(kLanes), hn::LoadU(Tag(), x + i), hn::LoadU(Tag(), y + i)), Tag(), powers + i);
}

void shading_powers_on_target(const double* x, const double* y, std::size_t count, double* powers) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes base = hn::LoadU(Tag(), x + i);
    hn::StoreU(shading_power_of(hn::Gt(base, all(0)), base, hn::LoadU(Tag(), y + i)), Tag(), powers + i);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(powers_on_target);
HWY_EXPORT(shading_powers_on_target);

namespace {

constexpr std::size_t kCount = 1 << 16;

class WavePowers : public ::testing::TestWithParam<std::string> {
 protected:
  WavePowers() { EXPECT_TRUE(use_target(GetParam())); }
  ~WavePowers() override { (void)use_target(""); }
};

TEST_P(WavePowers, powers_are_portable_pow) {
  SplitMix64 rng(1);
  std::vector<double> x(kCount), y(kCount), powers(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    x[i] = i % 8 == 0 ? std::exp(60 * rng.next_double() - 50) : 1.0000001 * rng.next_double() + 1e-12;
    y[i] = i % 5 == 0 ? 2000 * rng.next_double() - 500 : 100 * rng.next_double();
  }
  x[16] = 1e-310;
  y[40] = 0;
  y[41] = 1e300;
  x[42] = 1;
  HWY_DYNAMIC_DISPATCH(powers_on_target)(x.data(), y.data(), kCount, powers.data());
  for (std::size_t i = 0; i < kCount; ++i) ASSERT_EQ(powers[i], portable_pow(x[i], y[i])) << x[i] << " ^ " << y[i];
}

TEST_P(WavePowers, shading_powers_are_shading_power) {
  SplitMix64 rng(3);
  std::vector<double> x(kCount), y(kCount), powers(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    x[i] = 1.0000001 * rng.next_double() + 1e-12;
    // Some lanes are not wanted.
    if (i % 7 == 3) x[i] = i % 2 == 0 ? -x[i] : std::numeric_limits<double>::quiet_NaN();
    // Runs of one power, whole or not, and powers that change from lane to lane.
    if (i % 32 < 16 && i % 16 != 0)
      y[i] = y[i - 1];
    else
      y[i] = i % 3 == 0 ? 1100 * rng.next_double() : std::floor(1100 * rng.next_double());
  }
  y[0] = std::numeric_limits<double>::quiet_NaN();
  HWY_DYNAMIC_DISPATCH(shading_powers_on_target)(x.data(), y.data(), kCount, powers.data());
  EXPECT_TRUE(std::isnan(powers[0]));
  for (std::size_t i = 1; i < kCount; ++i) {
    if (!(x[i] > 0)) continue;
    ASSERT_EQ(powers[i], shading_power(x[i], y[i])) << x[i] << " ^ " << y[i];
  }
}

INSTANTIATE_TEST_SUITE_P(all, WavePowers, ::testing::ValuesIn(test::targets_under_test()));

}  // namespace
}  // namespace bihive
#endif
