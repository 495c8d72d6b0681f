// The vector form of normalized_again() against the scalar one, on every instruction set.
// ctest: inlined
// ctest: kernel
// ctest: asan-long
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/math/vec3.h"
#include "bihive/simd/target.h"
#include "support/effort.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "unit/wave_lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// Counts of multiples of 16.
void normalize_on_target(const Columns3<double>& from, std::int64_t count, Columns3<double>& to) {
  for (std::int64_t i = 0; i < count; i += kLanes) store(normalized_again(load(from, i)), to, i);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(normalize_on_target);

namespace {

class EachTarget : public ::testing::TestWithParam<std::string> {
 protected:
  EachTarget() { EXPECT_TRUE(use_target(GetParam())); }
  ~EachTarget() override { (void)use_target(""); }
};

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

// Lengths of almost 1 and other lengths, also beside each other.
TEST_P(EachTarget, vectors_are_normalized_as_one_by_one) {
  constexpr std::int64_t kCount = 1 << 14;
  SplitMix64 rng(1);
  Columns3<double> from, to;
  for (int axis = 0; axis < 3; ++axis) {
    from[axis].reserve(kCount);
    to[axis].reserve(kCount);
  }
  for (std::int64_t i = 0; i < kCount; ++i) {
    const auto next = [&] { return rng.next_double() - 0.5; };
    const Vec3d any{next(), next(), next()};
    Vec3d v = to_double(to_float(normalized(any)));
    if (i / 64 % 2 == 0 && i % 5 == 0) v = any;
    if (i / 64 % 2 == 0 && i % 11 == 0) v = (1 + 0x1p-17 * next()) * v;
    if (i % 97 == 0) v = {};
    if (i % 101 == 0) v.y = std::numeric_limits<double>::quiet_NaN();
    for (int axis = 0; axis < 3; ++axis) from[axis][i] = v[axis];
  }
  HWY_DYNAMIC_DISPATCH(normalize_on_target)(from, kCount, to);
  for (std::int64_t i = 0; i < kCount; ++i) {
    const Vec3d expected = normalized_again(Vec3d{from[0][i], from[1][i], from[2][i]});
    for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(same_bits(to[axis][i], expected[axis])) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(all, EachTarget, ::testing::ValuesIn(test::targets_under_test()));

}  // namespace
}  // namespace bihive
#endif
