#include "bihive/geometry/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

Cell cell_of(Vec3d a, Vec3d b, Vec3d c) {
  return Cell{{}, {a, b, c}};
}

TEST(Lattice, NeedsIndependentVectors) {
  EXPECT_FALSE(Lattice::of(std::optional<Cell>()));
  EXPECT_FALSE(Lattice::of(cell_of({}, {}, {})));
  EXPECT_FALSE(Lattice::of(cell_of({1, 0, 0}, {2, 0, 0}, {0, 0, 1})));
  EXPECT_FALSE(Lattice::of(cell_of({1, 0, 0}, {2, 0, 0}, {})));
  EXPECT_FALSE(Lattice::of(cell_of({1, 1, 0}, {1, 0, 1}, {0, 1, -1})));
  EXPECT_FALSE(Lattice::of(cell_of({1e-3, 0, 0}, {0, 1e10, 0}, {0, 0, 1e10})));
  EXPECT_FALSE(Lattice::of(cell_of({1, 0, 0}, {1, 1e-3, 0}, {0, 0, 1})));
  Cell none = cell_of({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_TRUE(Lattice::of(none));
  none.periodic = {false, false, false};
  EXPECT_FALSE(Lattice::of(none));
}

TEST(Lattice, SaysWhyThereIsNone) {
  const auto why = [](Vec3d a, Vec3d b, Vec3d c, std::array<bool, 3> periodic = {true, true, true}) {
    return Lattice::why_none({{}, {a, b, c}, periodic});
  };
  EXPECT_EQ(why({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), "");
  EXPECT_EQ(why({}, {}, {}), "");
  EXPECT_EQ(why({1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {false, false, false}), "");
  EXPECT_NE(why({1, 0, 0}, {2, 0, 0}, {0, 0, 1}), "");
  EXPECT_NE(why({1, 0, 0}, {0, 1e6, 0}, {0, 0, 1}), "");
}

TEST(Lattice, ExtendsAlongPeriodicVectorsAlone) {
  Cell slab = cell_of({4, 0, 0}, {1, 2, 0}, {0, 0, 8});
  slab.periodic[2] = false;
  for (const auto& lattice : {Lattice::of(slab), Lattice::of(cell_of({4, 0, 0}, {1, 2, 0}, {}))}) {
    ASSERT_TRUE(lattice);
    EXPECT_EQ(lattice->shift({1, -2, 0}), (Vec3d{2, -4, 0}));
    EXPECT_EQ(lattice->cell_of({5, 3, 100}), (ImageCounts{0, 1, 0}));
    const Lattice::Range range = lattice->images_within(1e3, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 10);
    EXPECT_EQ(range.first[2], 0);
    EXPECT_EQ(range.last[2], 0);
    EXPECT_LE(range.first[1], -500);
  }
  EXPECT_EQ(Lattice::of(cell_of({}, {0, 3, 0}, {}))->cell_of({7, -1, 2}), (ImageCounts{0, -1, 0}));
}

// Every image within the distance is in the range, in cells of every shape.
TEST(Lattice, RangeHoldsEveryImageWithinTheDistance) {
  SplitMix64 random(7);
  const auto number = [&](double from, double to) { return from + (to - from) * random.next_double(); };
  const auto vector = [&] { return Vec3d{number(-1, 1), number(-1, 1), number(-1, 1)}; };
  int cells = 0, found = 0;
  while (cells < 200) {
    const auto lattice = Lattice::of(cell_of(vector(), vector(), vector() * number(0.1, 3)));
    if (!lattice || lattice->condition() > 50) continue;
    ++cells;
    const Vec3d from = vector(), point = vector();
    const Vec3d share = lattice->shares(point);
    const double distance = number(0.01, 2.5);
    const auto range = lattice->images_within(distance, from, share, share, 1);
    std::int64_t inside = 0, visited = 0;
    for (std::int64_t i = -12; i <= 12; ++i)
      for (std::int64_t j = -12; j <= 12; ++j)
        for (std::int64_t k = -12; k <= 12; ++k) {
          if (length(point + lattice->shift({i, j, k}) - from) > distance) continue;
          ++found;
          const ImageCounts n{i, j, k};
          bool held = true;
          for (std::size_t axis = 0; axis < 3; ++axis)
            held = held && range.first[axis] <= n[axis] && n[axis] <= range.last[axis];
          inside += held ? 0 : 1;
        }
    EXPECT_EQ(inside, 0) << "cell " << cells;
    any_image(range, [&](const ImageCounts&) { return ++visited, false; });
    EXPECT_EQ(double(visited), range.empty() ? 0 : range.count());
  }
  EXPECT_GT(found, 1000);
}

}  // namespace
}  // namespace bihive
