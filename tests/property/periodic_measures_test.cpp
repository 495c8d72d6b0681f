// Measures of periodic sets: closed forms, points, larger cells, spheres that are stored elsewhere, and what is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "bihive/geometry/lattice.h"
#include "bihive/math/rng.h"
#include "bihive/measure/lattice_union_find.h"
#include "bihive/measure/union_measures.h"
#include "support/effort.h"
#include "support/world.h"

// ctest: threads

namespace bihive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Vectors = std::array<Vec3d, 3>;
using Counts = std::array<std::int64_t, 3>;

constexpr Vectors kCube{Vec3d{2, 0, 0}, Vec3d{0, 2, 0}, Vec3d{0, 0, 2}};

double ball_volume(double r) {
  return 4 * std::numbers::pi / 3 * r * r * r;
}
double cap_volume(double r, double h) {
  return std::numbers::pi / 3 * (r - h) * (r - h) * (2 * r + h);
}

SphereSet set_of(const test::World& world, const Vectors& vectors) {
  SphereSet set = test::sphere_set(world);
  set.cell() = Cell{{}, vectors};
  return set;
}
SphereSet one_sphere(double r, const Vectors& vectors = kCube) {
  test::World world;
  world.add(0.25, -3, 7, r);
  return set_of(world, vectors);
}

MeasureOptions periodic_options() {
  MeasureOptions options;
  options.periodic = options.cavities = options.sphere_volumes = options.contacts = true;
  return options;
}
UnionMeasures measures_of(const SphereSet& set) {
  return measure_union(set, periodic_options()).value();
}

TEST(PeriodicMeasures, OneSphereInACubicCell) {
  // Free, then with lenses along the cell's edges, then of a size at which the spheres of all cells cover everything.
  const UnionMeasures free = measures_of(one_sphere(0.75));
  EXPECT_NEAR(free.volume, ball_volume(0.75), 1e-14);
  EXPECT_NEAR(free.porosity, 1 - ball_volume(0.75) / 8, 1e-15);
  EXPECT_EQ(free.components, 1);
  EXPECT_TRUE(free.contacts.empty());
  EXPECT_TRUE(free.channels.empty());
  EXPECT_TRUE(free.cavities.empty());

  const UnionMeasures touching = measures_of(one_sphere(1));
  EXPECT_NEAR(touching.porosity, 1 - std::numbers::pi / 6, 1e-15);
  EXPECT_TRUE(touching.channels.empty());

  const UnionMeasures lenses = measures_of(one_sphere(1.25));
  EXPECT_NEAR(lenses.volume, ball_volume(1.25) - 6 * cap_volume(1.25, 1), 1e-14);
  EXPECT_NEAR(lenses.area, 4 * std::numbers::pi * 1.25 * 1.25 - 6 * 2 * std::numbers::pi * 1.25 * 0.25, 1e-13);
  EXPECT_NEAR(lenses.porosity, 1 - lenses.volume / 8, 1e-15);
  EXPECT_LT(lenses.porosity_error, 1e-11);
  ASSERT_EQ(lenses.contacts.size(), 3u);
  EXPECT_EQ(lenses.contacts[0].image, (Counts{0, 0, 1}));
  EXPECT_EQ(lenses.contacts[2].image, (Counts{1, 0, 0}));
  for (const Contact& contact : lenses.contacts) EXPECT_NEAR(contact.area, std::numbers::pi * (1.25 * 1.25 - 1), 1e-14);
  ASSERT_EQ(lenses.channels.size(), 1u);
  EXPECT_THAT(lenses.channels[0].translations, ElementsAre(Counts{1, 0, 0}, Counts{0, 1, 0}, Counts{0, 0, 1}));
  EXPECT_NEAR(lenses.channels[0].area, lenses.area, 1e-13);
  EXPECT_THAT(lenses.channels[0].spheres, ElementsAre(0));

  // Beyond sqrt(2) the hollows are closed.
  const UnionMeasures hollow = measures_of(one_sphere(1.5));
  EXPECT_TRUE(hollow.channels.empty());
  ASSERT_EQ(hollow.cavities.size(), 1u);
  EXPECT_NEAR(hollow.cavities[0].volume, 8 - hollow.volume, 1e-13);
  EXPECT_NEAR(hollow.cavities[0].volume / 8, hollow.porosity, 1e-14);
  EXPECT_NEAR(hollow.cavities[0].area, hollow.area, 1e-13);
  EXPECT_EQ(hollow.components, 1);

  for (const double r : {1.75, 3.0, 5.0}) {
    const UnionMeasures all = measures_of(one_sphere(r));
    EXPECT_EQ(all.area, 0);
    EXPECT_NEAR(all.volume, 8, 1e-12);
    EXPECT_NEAR(all.porosity, 0, 1e-13);
    EXPECT_LE(std::abs(all.porosity), all.porosity_error);
    EXPECT_TRUE(all.cavities.empty());
    for (const Contact& contact : all.contacts) EXPECT_NEAR(contact.area, 4, 1e-10);
    EXPECT_EQ(all.contacts.size(), 3u);
  }
}

TEST(PeriodicMeasures, ClosePackingsInPrimitiveCells) {
  // fcc with a conventional edge of 4: neighbours at 2 sqrt(2).
  const Vectors fcc{Vec3d{0, 2, 2}, Vec3d{2, 0, 2}, Vec3d{2, 2, 0}};
  const double r = 1.5, h = std::sqrt(2.0);  // twelve lenses that do not meet
  const UnionMeasures measures = measures_of(one_sphere(r, fcc));
  EXPECT_NEAR(measures.cell_volume, 16, 1e-14);
  EXPECT_NEAR(measures.volume, ball_volume(r) - 12 * cap_volume(r, h), 1e-13);
  EXPECT_EQ(measures.contacts.size(), 6u);
  // bcc: eight neighbours at sqrt(3) for an edge of 2.
  const Vectors bcc{Vec3d{-1, 1, 1}, Vec3d{1, -1, 1}, Vec3d{1, 1, -1}};
  const double s = 0.875, half = std::sqrt(3.0) / 2;
  EXPECT_NEAR(measures_of(one_sphere(s, bcc)).volume, ball_volume(s) - 8 * cap_volume(s, half), 1e-13);
}

TEST(PeriodicMeasures, RodsAndSlabsAreToldApart) {
  const auto translations_of = [](const Vectors& vectors) {
    const UnionMeasures measures = measures_of(one_sphere(1, vectors));
    std::vector<std::vector<Counts>> all;
    for (const PercolatingSurface& channel : measures.channels) all.push_back(channel.translations);
    return all;
  };
  const Vec3d far_x{8, 0, 0}, far_y{0, 8, 0}, near_y{0, 1.5, 0}, near_x{1.5, 0, 0}, near_z{0.5, 0, 1.5};
  EXPECT_TRUE(translations_of({far_x, far_y, Vec3d{0, 0, 8}}).empty());
  EXPECT_THAT(translations_of({far_x, far_y, near_z}), ElementsAre(std::vector<Counts>{{0, 0, 1}}));
  // Spheres that meet along the difference of two vectors.
  EXPECT_THAT(translations_of({far_x, far_y, Vec3d{8, 0, 1.5}}), ElementsAre(std::vector<Counts>{{1, 0, -1}}));
  // Two sides of a slab without holes.
  const Vectors slab{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 8}};
  const std::vector<Counts> plane{{1, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(translations_of(slab), ElementsAre(plane, plane));
  // A net has one surface.
  EXPECT_THAT(translations_of({near_x, near_y, Vec3d{0, 0, 8}}), ElementsAre(plane));
}

test::World random_world(SplitMix64& rng, int count, double spread, double smallest, double largest) {
  test::World world;
  for (int i = 0; i < count; ++i) {
    const auto at = [&] { return spread * rng.next_double(); };
    world.add(at(), at(), at(), smallest + (largest - smallest) * rng.next_double());
  }
  return world;
}

// Skewed cells, smaller and larger than the spheres.
Vectors random_cell(SplitMix64& rng, double size) {
  const auto some = [&](double range) { return range * (rng.next_double() - 0.5); };
  return {Vec3d{size * (0.75 + some(0.5)), size * some(0.5), size * some(0.5)},
          Vec3d{size * some(0.5), size * (0.75 + some(0.5)), size * some(0.5)},
          Vec3d{size * some(0.5), size * some(0.5), size * (0.75 + some(0.5))}};
}

TEST(PeriodicMeasures, AgreeWithPoints) {
  SplitMix64 rng(17);
  const int sets = test::at_least(3, 5), points = test::at_least(5000, 40'000);
  for (int set = 0; set < sets; ++set) {
    const int count = 1 + set;
    const Vectors vectors = random_cell(rng, 1);
    const SphereSet spheres = set_of(random_world(rng, count, 2, 0.05, 0.3), vectors);
    const UnionMeasures measures = measures_of(spheres);
    const Lattice lattice = *Lattice::of(spheres.cell());
    int hits = 0;
    std::vector<int> nearest(static_cast<std::size_t>(count));
    for (int n = 0; n < points; ++n) {
      const Vec3d x = rng.next_double() * vectors[0] + rng.next_double() * vectors[1] + rng.next_double() * vectors[2];
      double least = 0;
      int best = -1;
      for (int i = 0; i < count; ++i) {
        const Vec3d centre = spheres.centre(i), share = lattice.shares(centre);
        any_image(lattice.images_within(0.3, x, share, share, 4), [&](const ImageCounts& counts) {
          const Vec3d between = x - centre - lattice.shift(counts);
          const double power = dot(between, between) - spheres.radius(i) * spheres.radius(i);
          if (power < least) least = power, best = i;
          return false;
        });
      }
      if (best < 0) continue;
      ++hits;
      ++nearest[best];
    }
    const auto expect_share = [&](double volume, int found) {
      const double share = volume / measures.cell_volume;
      EXPECT_NEAR(double(found) / points, share, 5 * std::sqrt(share * (1 - share) / points) + 1e-12) << "set " << set;
    };
    expect_share(measures.volume, hits);
    for (int i = 0; i < count; ++i) expect_share(measures.sphere_volume[i], nearest[i]);
    EXPECT_NEAR(std::accumulate(measures.sphere_volume.begin(), measures.sphere_volume.end(), 0.0), measures.volume,
                measures.volume_error);
  }
}

// The same union in a cell of several, whatever the shape.
TEST(PeriodicMeasures, LargerCellsHoldMultiples) {
  SplitMix64 rng(23);
  const int sets = test::at_least(3, 30);
  for (int set = 0; set < sets; ++set) {
    // On a grid, so that copies are exact, and in half of the sets degenerate.
    const double grid = set % 2 == 0 ? 4 : 1024;
    const auto rounded = [&](double x) { return std::round(x * grid) / grid; };
    Vectors vectors = random_cell(rng, 2);
    for (Vec3d& vector : vectors) vector = {rounded(vector.x), rounded(vector.y), rounded(vector.z)};
    if (!Lattice::of(Cell{{}, vectors})) continue;
    test::World world, large;
    const int count = 1 + set % 6;
    for (int i = 0; i < count; ++i)
      world.add(rounded(2 * rng.next_double()), rounded(2 * rng.next_double()), rounded(2 * rng.next_double()),
                0.25 + rounded(0.75 * rng.next_double()));
    const Counts counts{2, 1, 3};
    for (int a = 0; a < counts[0]; ++a)
      for (int c = 0; c < counts[2]; ++c)
        for (int i = 0; i < count; ++i) {
          const Vec3d shift = double(a) * vectors[0] + double(c) * vectors[2];
          large.add(world.x[i] + shift.x, world.y[i] + shift.y, world.z[i] + shift.z, world.r[i]);
        }
    const UnionMeasures one = measures_of(set_of(world, vectors));
    const UnionMeasures six = measures_of(set_of(large, {2.0 * vectors[0], vectors[1], 3.0 * vectors[2]}));
    EXPECT_NEAR(6 * one.area, six.area, 1e-11) << "set " << set;
    EXPECT_NEAR(6 * one.volume, six.volume, 1e-11) << "set " << set;
    EXPECT_NEAR(one.porosity, six.porosity, 1e-12) << "set " << set;
    double contacts = 0, all_contacts = 0;
    for (const Contact& contact : one.contacts) contacts += contact.area;
    for (const Contact& contact : six.contacts) all_contacts += contact.area;
    EXPECT_NEAR(6 * contacts, all_contacts, 1e-10) << "set " << set;
    double cavities = 0, all_cavities = 0;
    for (const Cavity& cavity : one.cavities) cavities += cavity.volume;
    for (const Cavity& cavity : six.cavities) all_cavities += cavity.volume;
    EXPECT_EQ(6 * one.cavities.size(), six.cavities.size()) << "set " << set;
    EXPECT_NEAR(6 * cavities, all_cavities, 1e-10) << "set " << set;
    EXPECT_EQ(one.channels.empty(), six.channels.empty()) << "set " << set;
  }
}

TEST(PeriodicMeasures, SpheresMayBeStoredInAnyCell) {
  SplitMix64 rng(29);
  const int sets = test::at_least(5, 50);
  for (int set = 0; set < sets; ++set) {
    const auto below = [&](int n) { return static_cast<int>(n * rng.next_double()); };
    const Vectors vectors{Vec3d{1.5, 0, 0}, Vec3d{0.5, 1.25, 0}, Vec3d{-0.25, 0.5, 1}};
    test::World here, elsewhere;
    for (int i = 0; i <= below(8); ++i) {
      const Vec3d at{below(8) / 8.0, below(8) / 8.0, below(8) / 8.0};
      const Vec3d moved = at + double(below(9) - 4) * vectors[0] + double(below(9) - 4) * vectors[1] +
                          double(below(9) - 4) * vectors[2];
      const double r = (1 + below(5)) / 8.0;
      here.add(at.x, at.y, at.z, r);
      elsewhere.add(moved.x, moved.y, moved.z, r);
    }
    const UnionMeasures one = measures_of(set_of(here, vectors)), other = measures_of(set_of(elsewhere, vectors));
    EXPECT_NEAR(one.area, other.area, 1e-12) << "set " << set;
    EXPECT_NEAR(one.volume, other.volume, 1e-12) << "set " << set;
    EXPECT_EQ(one.cavities.size(), other.cavities.size()) << "set " << set;
    EXPECT_EQ(one.components, other.components) << "set " << set;
    ASSERT_EQ(one.channels.size(), other.channels.size()) << "set " << set;
    for (std::size_t c = 0; c < one.channels.size(); ++c)
      EXPECT_EQ(one.channels[c].translations, other.channels[c].translations) << "set " << set;
    EXPECT_EQ(one.undecided_spheres, 0);
    // Images of contacts are those of where the spheres are stored.
    ASSERT_EQ(one.contacts.size(), other.contacts.size()) << "set " << set;
    const SphereSet stored = set_of(elsewhere, vectors);
    for (const Contact& contact : other.contacts) {
      const Vec3d shift = double(contact.image[0]) * vectors[0] + double(contact.image[1]) * vectors[1] +
                          double(contact.image[2]) * vectors[2];
      const double apart = length(stored.centre(contact.second) + shift - stored.centre(contact.first));
      EXPECT_LT(apart, stored.radius(contact.first) + stored.radius(contact.second)) << "set " << set;
    }
  }
}

// A sphere that lies on a face of the cell is stored at both sides by some programs: it counts once.
TEST(PeriodicMeasures, EqualImagesCountOnce) {
  test::World world;
  world.add(0, 0, 0, 0.75);
  world.add(2, 0, 0, 0.75);
  world.add(0, 2, 2, 0.75);
  const UnionMeasures measures = measures_of(set_of(world, kCube));
  EXPECT_NEAR(measures.volume, ball_volume(0.75), 1e-14);
  EXPECT_EQ(measures.components, 1);
  EXPECT_EQ(measures.sphere_area[1], 0);
  EXPECT_EQ(measures.sphere_volume[2], 0);
}

TEST(PeriodicMeasures, FewerPeriodicVectors) {
  test::World world;
  world.add(0, 0, 0, 1.25);
  SphereSet set = test::sphere_set(world);
  set.cell() = Cell{{}, kCube, {true, false, false}};
  const UnionMeasures measures = measures_of(set);
  EXPECT_NEAR(measures.volume, ball_volume(1.25) - 2 * cap_volume(1.25, 1), 1e-14);
  EXPECT_TRUE(std::isnan(measures.porosity));
  ASSERT_EQ(measures.channels.size(), 1u);
  EXPECT_THAT(measures.channels[0].translations, ElementsAre(Counts{1, 0, 0}));
}

TEST(PeriodicMeasures, SameBitsOnAnyNumberOfThreadsAndByTheTree) {
  SplitMix64 rng(31);
  test::World world = random_world(rng, test::at_least(400, 2000), 16, 0.25, 1);
  const Vectors vectors{Vec3d{16, 0, 0}, Vec3d{1, 16, 0}, Vec3d{0, -2, 16}};
  const SphereSet set = set_of(world, vectors);
  MeasureOptions options = periodic_options();
  options.threads = 1;
  const UnionMeasures one = measure_union(set, options).value();
  options.threads = 3;
  const UnionMeasures three = measure_union(set, options).value();
  EXPECT_EQ(one.area, three.area);
  EXPECT_EQ(one.volume, three.volume);
  EXPECT_EQ(one.sphere_volume, three.sphere_volume);
  ASSERT_EQ(one.contacts.size(), three.contacts.size());
  for (std::size_t n = 0; n < one.contacts.size(); ++n) EXPECT_EQ(one.contacts[n].area, three.contacts[n].area);
  ASSERT_EQ(one.channels.size(), three.channels.size());
  for (std::size_t n = 0; n < one.channels.size(); ++n) EXPECT_EQ(one.channels[n].spheres, three.channels[n].spheres);

  // Two clusters in a cell that is much larger: measured by the tree, and as without images.
  test::World both;
  for (std::size_t i = 0; i < 400; ++i) {
    both.add(world.x[i], world.y[i], world.z[i], world.r[i]);
    both.add(world.x[i] + 65536, world.y[i], world.z[i], world.r[i]);
  }
  const SphereSet clusters = set_of(both, {Vec3d{1e5, 0, 0}, Vec3d{0, 1e5, 0}, Vec3d{0, 0, 1e5}});
  const UnionMeasures within = measures_of(clusters), alone = measure_union(clusters).value();
  EXPECT_NEAR(within.area, alone.area, within.area_error);
  EXPECT_NEAR(within.volume, alone.volume, alone.volume_error);
  EXPECT_TRUE(within.channels.empty());
}

TEST(PeriodicMeasures, Refusals) {
  const auto message_of = [](const SphereSet& set, double probe = 0) {
    MeasureOptions options = periodic_options();
    options.probe = probe;
    const auto measures = measure_union(set, options);
    return measures ? std::string() : measures.error().message;
  };
  test::World world;
  world.add(0, 0, 0, 1);
  EXPECT_THAT(message_of(test::sphere_set(world)), HasSubstr("no periodic cell"));
  EXPECT_THAT(message_of(one_sphere(1, {kCube[0], kCube[0], kCube[2]})), HasSubstr("in a plane or on a line"));
  EXPECT_THAT(message_of(one_sphere(1), 100), HasSubstr("8,192 images"));
  world.add(1e6, 0, 0, 1);
  EXPECT_THAT(message_of(set_of(world, kCube)), HasSubstr("8,192 cells"));
  // Nothing to measure.
  EXPECT_EQ(message_of(one_sphere(0)), "");
  EXPECT_EQ(measures_of(one_sphere(0)).porosity, 1);
}

TEST(PeriodicMeasures, TranslationsHaveOneBasis) {
  measure::Translations one, other;
  for (const ImageCounts& counts : {ImageCounts{2, 4, 6}, ImageCounts{1, 5, 3}, ImageCounts{4, 14, 12}})
    one.add(counts);
  for (const ImageCounts& counts : {ImageCounts{-1, -5, -3}, ImageCounts{3, 9, 9}}) other.add(counts);
  EXPECT_EQ(one.rows(), other.rows());
  EXPECT_EQ(one.rows().size(), 2u);
  EXPECT_TRUE(measure::Translations().rows().empty());
}

}  // namespace
}  // namespace bihive
