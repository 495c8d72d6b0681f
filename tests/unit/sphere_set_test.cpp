#include "bihive/geometry/sphere_set.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace bihive {
namespace {

using Doubles = std::vector<double>;
using Floats = std::vector<float>;

SphereSet one(double x, double y, double z, double r) {
  Result<SphereSet> set = SphereSet::from_world(Doubles{x}, Doubles{y}, Doubles{z}, Doubles{r});
  EXPECT_TRUE(set.ok()) << set.error().to_string();
  return *set;
}

TEST(SphereSet, StoresEveryBoundWithinOneAndComesBackExactly) {
  const Floats x{1, -2.5f, 1000.125f}, y{0, 3, 4}, z{5, 6, -7}, r{0.5f, 0, 1};
  const Result<SphereSet> set = SphereSet::from_world(x, y, z, r);
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->size(), 3);
  EXPECT_EQ(set->scale_exponent(), -10);
  for (std::int64_t id = 0; id < 3; ++id) {
    const auto i = static_cast<std::size_t>(id);
    EXPECT_EQ(set->centre(id), (Vec3d{double(x[i]), double(y[i]), double(z[i])}));
    EXPECT_EQ(set->radius(id), double(r[i]));
    const Aabb box = set->stored_box(id);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(box.lo[axis], -1);
      EXPECT_LE(box.hi[axis], 1);
    }
  }
}

TEST(SphereSet, ScalesTheSmallestAndTheLargestOfBinary32) {
  for (const float r : {1e-45f, 1e-38f, 1e-20f, 1e20f, 3.4e38f}) {
    const SphereSet set = one(0, 0, 0, double(r));
    EXPECT_EQ(set.radius(0), double(r));
    EXPECT_GE(set.stored_radius(0), 0.5);
    EXPECT_LE(set.stored_radius(0), 1);
  }
  const SphereSet corner = one(3.4e38, -3.4e38, 0, 3.4e38);
  EXPECT_EQ(corner.scale_exponent(), -129);
  EXPECT_LE(corner.stored_box(0).hi.x, 1);
}

TEST(SphereSet, TakesNumbersBelowBinary32WithoutBreaking) {
  // A file may hold any binary64. Vanishing radii are counted, and nothing becomes NaN or infinite.
  for (const double r : {5e-324, 1e-310, 1e-300, 1e-60}) {
    const SphereSet set = one(r, 0, -r, r);
    EXPECT_LE(set.scale_exponent(), 149);
    EXPECT_TRUE(std::isfinite(set.scale()));
    EXPECT_TRUE(std::isfinite(set.x()[0]));
    EXPECT_TRUE(std::isfinite(set.r()[0]));
    EXPECT_EQ(set.z()[0], -set.x()[0]);
    EXPECT_EQ(set.vanishing_radii(), set.stored_radius(0) < 0x1p-60 ? 1 : 0);
  }
}

TEST(SphereSet, RoundsOnce) {
  // 1 + 2^-24 + 2^-50 rounds up; with an intermediate rounding it could go to even, which is down.
  const double x = 1 + 0x1p-24 + 0x1p-50;
  EXPECT_EQ(one(x, 0, 0, 0.5).centre(0).x, 1 + 0x1p-23);
}

TEST(SphereSet, StatesVanishingRadii) {
  const Doubles x{0, 0, 0, 1}, r{0x1p-60, 0x1p-58, 0, 1};
  const Result<SphereSet> set = SphereSet::from_world(x, Doubles(4), Doubles(4), r);
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->scale_exponent(), -2);  // the bound 2 rounds up to the next power
  EXPECT_EQ(set->vanishing_radii(), 1) << "0 itself is not counted: it is never hit by definition";
}

TEST(SphereSet, RefusesWhatNoSphereCanBeAndNamesItsPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const double bad[][4] = {{nan, 0, 0, 1}, {0, inf, 0, 1},  {0, 0, -inf, 1},   {0, 0, 0, nan},
                           {0, 0, 0, inf}, {1e39, 0, 0, 1}, {0, -1e300, 0, 1}, {0, 0, 0, -1e-30}};
  for (const auto& b : bad) {
    const Result<SphereSet> set =
        SphereSet::from_world(Doubles{0, b[0]}, Doubles{0, b[1]}, Doubles{0, b[2]}, Doubles{1, b[3]});
    ASSERT_FALSE(set.ok()) << b[0] << " " << b[1] << " " << b[2] << " " << b[3];
    const std::string text = set.error().to_string();
    EXPECT_NE(text.find("sphere 1"), std::string::npos) << text;
    EXPECT_LT(text.size(), 160u) << text;
  }
}

TEST(SphereSet, MayBeEmpty) {
  const Result<SphereSet> set = SphereSet::from_world(Floats{}, Floats{}, Floats{}, Floats{});
  ASSERT_TRUE(set.ok());
  EXPECT_TRUE(set->empty());
  EXPECT_EQ(set->scale(), 1);
}

TEST(SphereSet, BoundsAreInWorldUnits) {
  const Result<SphereSet> set = SphereSet::from_world(Floats{-3, 10}, Floats{1, 2}, Floats{0, 0}, Floats{1, 0.5f});
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->bounds().lo, (Vec3d{-4, 0, -1}));
  EXPECT_EQ(set->bounds().hi, (Vec3d{10.5, 2.5, 1}));
}

TEST(SphereSet, CountsWhatItHolds) {
  SphereSet set = one(0, 0, 0, 1);
  const std::int64_t bare = set.allocated_bytes();
  EXPECT_GE(bare, 16);
  set.attributes().type.resize(100);
  set.attributes().numbers.push_back({"charge", std::vector<double>(10)});
  EXPECT_GE(set.allocated_bytes(), bare + 400 + 80);
}

// Numbers that lie somewhere else, as those of Python's arrays do: the same set as that of vectors.
TEST(SphereSet, takes_numbers_where_they_lie) {
  using Precision = NumbersView::Precision;
  const auto equal = [](const SphereSet& a, const SphereSet& b) {
    return a.x() == b.x() && a.y() == b.y() && a.z() == b.z() && a.r() == b.r() &&
           a.scale_exponent() == b.scale_exponent();
  };
  // Rows of x, y, z, r, from the last to the first; an odd place in memory.
  const std::vector<double> rows{1.1, 2.2, 3.3, 0.4, -5.5, 6.6, -7.7, 0.8};
  const auto same = [&](auto number, Precision precision) {
    using T = decltype(number);
    std::vector<char> bytes(1 + rows.size() * sizeof(T));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const T value = static_cast<T>(rows[i]);
      std::memcpy(bytes.data() + 1 + i * sizeof(T), &value, sizeof(T));
    }
    const auto column = [&](std::size_t k) {
      return NumbersView{bytes.data() + 1 + (4 + k) * sizeof(T), -static_cast<std::ptrdiff_t>(4 * sizeof(T)), 2,
                         precision};
    };
    const auto number_at = [&](std::size_t i) { return static_cast<T>(rows[i]); };
    const Result<SphereSet> expected =
        SphereSet::from_world(std::vector<T>{number_at(4), number_at(0)}, std::vector<T>{number_at(5), number_at(1)},
                              std::vector<T>{number_at(6), number_at(2)}, std::vector<T>{number_at(7), number_at(3)});
    const Result<SphereSet> found = SphereSet::from_world(column(0), column(1), column(2), column(3));
    ASSERT_TRUE(expected && found);
    EXPECT_TRUE(equal(*found, *expected));
    // One radius for all, of the other precision too.
    const double wide = 0.1;
    const float narrow = 0.1f;
    const Result<SphereSet> by_double = SphereSet::from_world(column(0), column(1), column(2), {&wide, 0, 2});
    const Result<SphereSet> by_float =
        SphereSet::from_world(column(0), column(1), column(2), {&narrow, 0, 2, Precision::binary32});
    ASSERT_TRUE(by_double && by_float);
    EXPECT_TRUE(equal(*by_double, *by_float));
    EXPECT_EQ(static_cast<float>(by_double->radius(1)), 0.1f);
  };
  same(double{}, Precision::binary64);
  same(float{}, Precision::binary32);
}

TEST(SphereSet, refuses_the_same_numbers_where_they_lie) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> x{0, nan};
  const NumbersView zeros{x.data(), 0, 2}, bad{x.data(), sizeof(double), 2};
  const Result<SphereSet> set = SphereSet::from_world(zeros, bad, zeros, zeros);
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().message, "sphere 1: y must be finite but is nan");
  EXPECT_TRUE(SphereSet::from_world(NumbersView{}, NumbersView{}, NumbersView{}, NumbersView{})->empty());
}

// An empty set has no spheres to count, but its copies are.
TEST(SphereSet, an_empty_set_has_a_limit_of_copies_too) {
  SphereSet nothing;
  const std::array<Vec3d, 3> cube{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  constexpr std::int32_t kMany = std::numeric_limits<std::int32_t>::max();
  const Status status = nothing.replicate(cube, {kMany, kMany, kMany});
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("2^40"), std::string::npos) << status.error().message;
  EXPECT_FALSE(nothing.has_images());
  ASSERT_TRUE(nothing.replicate(cube, {2, 3, 4}));
  EXPECT_EQ(nothing.total_size(), 0);
}

}  // namespace
}  // namespace bihive
