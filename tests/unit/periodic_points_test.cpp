#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/math/rng.h"
#include "bihive/select/selection.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/trace/points.h"
#include "support/periodic_cells.h"

namespace bihive {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

using test::PeriodicSet;

// Radii of one, two and three times this number in turn.
PeriodicSet set_of(const std::vector<Vec3d>& centres, double radius, const Cell& cell) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < centres.size(); ++i) radii.push_back(radius * (1 + double(i % 3)));
  return {centres, radii, cell};
}

PointOptions options_of(const PeriodicSet& set, DistanceTo to) {
  PointOptions options;
  options.to = to;
  options.images = set.images ? &*set.images : nullptr;
  return options;
}

// All images of all spheres, moved by -reach to reach along each periodic vector, within a distance: world units.
std::vector<wide::NearSphere> all_within(const PeriodicSet& set, Vec3d point, double limit, DistanceTo to, int reach) {
  const SphereSet& spheres = set.spheres;
  std::vector<wide::NearSphere> found;
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    test::for_each_shift(spheres, reach, [&](Vec3d shift) {
      const double distance =
          image_distance(point * spheres.scale(), spheres.stored_centre(id), shift, spheres.stored_radius(id), to);
      if (distance <= limit * spheres.scale()) found.push_back({distance * spheres.inverse_scale(), id});
    });
  return found;
}

TEST(PeriodicPoints, AgreeWithAllImages) {
  SplitMix64 random(11);
  for (const Cell& cell : test::periodic_cells())
    for (const bool is_scattered : {false, true}) {
      std::vector<Vec3d> centres, points;
      for (int i = 0; i < 12; ++i) {
        centres.push_back(test::point_in(cell, random));
        if (is_scattered && i % 3 == 0)
          centres.back() = centres.back() + double(random.next_below(4)) * cell.vectors[0] - 2.0 * cell.vectors[1];
      }
      centres.push_back(centres[4]);
      for (int i = 0; i < 8; ++i)
        points.push_back(test::point_in(cell, random) + (i % 2 == 0 ? 1.0 : -2.0) * cell.vectors[1]);
      points.push_back(centres[0]);
      const PeriodicSet set = set_of(centres, 0.1, cell);
      ASSERT_TRUE(set.images);
      std::vector<double> xyz;
      for (const Vec3d& p : points) xyz.insert(xyz.end(), {p.x, p.y, p.z});
      const PointSpan span = PointSpan::rows(xyz.data(), static_cast<std::int64_t>(points.size()));
      for (const DistanceTo to : {DistanceTo::centre, DistanceTo::surface}) {
        for (const double limit : {-0.05, 0.0, 0.7, 3.0}) {
          const SphereLists lists = spheres_within(*set.tree, span, limit, options_of(set, to)).value();
          for (std::size_t i = 0; i < points.size(); ++i) {
            std::vector<wide::NearSphere> expected = all_within(set, points[i], limit, to, 8);
            std::sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) {
              return a.id != b.id ? a.id < b.id : a.distance < b.distance;
            });
            const auto first = static_cast<std::size_t>(lists.begin[i]);
            ASSERT_EQ(lists.begin[i + 1] - lists.begin[i], static_cast<std::int64_t>(expected.size()))
                << limit << ' ' << is_scattered << ' ' << i;
            for (std::size_t k = 0; k < expected.size(); ++k) {
              EXPECT_EQ(lists.sphere_id[first + k], expected[k].id);
              EXPECT_EQ(lists.distance[first + k], expected[k].distance);
            }
          }
        }
        for (const std::int64_t most : {1, 5, 40}) {
          const NearestSpheres nearest = nearest_spheres(*set.tree, span, most, kInf, options_of(set, to)).value();
          for (std::size_t i = 0; i < points.size(); ++i) {
            std::vector<wide::NearSphere> expected = all_within(set, points[i], kInf, to, 8);
            std::sort(expected.begin(), expected.end());
            for (std::size_t k = 0; k < std::size_t(most) && k < expected.size(); ++k) {
              if (expected.size() < 200 && k >= expected.size() / 4) break;  // farther ones are not among them all
              const std::size_t at = i * std::size_t(most) + k;
              EXPECT_EQ(nearest.distance[at], expected[k].distance) << most << ' ' << is_scattered;
              EXPECT_EQ(nearest.sphere_id[at], expected[k].id);
            }
          }
        }
      }
    }
}

TEST(PeriodicPoints, EveryAtomOfACrystalHasTwelveNeighbours) {
  // Face-centred cubic: the primitive cell with one atom, and 2 x 2 x 2 cubic cells.
  const PeriodicSet primitive = set_of({Vec3d{}}, 0.1, {{}, {Vec3d{0, 1, 1}, Vec3d{1, 0, 1}, Vec3d{1, 1, 0}}});
  const double origin[3] = {};
  const SphereLists lists =
      spheres_within(*primitive.tree, PointSpan::rows(origin, 1), 1.5, options_of(primitive, DistanceTo::centre))
          .value();
  EXPECT_EQ(lists.begin[1], 13);  // with the atom itself
  std::vector<Vec3d> centres;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        if ((i + j + k) % 2 == 0) centres.push_back({double(i), double(j), double(k)});
  const PeriodicSet cubic = set_of(centres, 0.1, {{}, {Vec3d{4, 0, 0}, Vec3d{0, 4, 0}, Vec3d{0, 0, 4}}});
  std::vector<double> xyz;
  for (const Vec3d& p : centres) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  const PointSpan span = PointSpan::rows(xyz.data(), static_cast<std::int64_t>(centres.size()));
  const SphereLists near = spheres_within(*cubic.tree, span, 1.5, options_of(cubic, DistanceTo::centre)).value();
  for (std::size_t i = 0; i < centres.size(); ++i) EXPECT_EQ(near.begin[i + 1] - near.begin[i], 13);
  const NearestSpheres thirteen =
      nearest_spheres(*cubic.tree, span, 14, kInf, options_of(cubic, DistanceTo::centre)).value();
  EXPECT_EQ(thirteen.distance[12], std::sqrt(2.0));
  EXPECT_EQ(thirteen.distance[13], 2);
}

TEST(PeriodicPoints, HostileQuestionsEnd) {
  const Cell cell{{}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}};
  // One sphere lies a million cells away from the others.
  PeriodicSet set = set_of({Vec3d{0.5, 0.5, 0.5}, Vec3d{1e6, 0, 0}}, 0.1, cell);
  const double points[6] = {0, 0, 0, -1e7, 3, 0.5};
  PointOptions options = options_of(set, DistanceTo::centre);
  const NearestSpheres nearest = nearest_spheres(*set.tree, PointSpan::rows(points, 2), 1, kInf, options).value();
  EXPECT_EQ(nearest.sphere_id, (std::vector<std::int64_t>{1, 1}));
  EXPECT_EQ(nearest.distance[0], 0);
  const std::uint8_t none[2] = {0, 0};
  options.mask = none;
  for (const double within : {kInf, 1e30, 2.0}) {
    const NearestSpheres nothing = nearest_spheres(*set.tree, PointSpan::rows(points, 2), 3, within, options).value();
    EXPECT_EQ(nothing.sphere_id, std::vector<std::int64_t>(6, kNothing));
  }
  options.mask = nullptr;
  EXPECT_FALSE(spheres_within(*set.tree, PointSpan::rows(points, 2), kInf, options));
  EXPECT_FALSE(spheres_within(*set.tree, PointSpan::rows(points, 2), 1e4, options));
  const NearestSpheres far = nearest_spheres(*set.tree, PointSpan::rows(points, 1), 9, 1e30, options).value();
  EXPECT_NE(far.sphere_id[8], kNothing);
  // A point, or a sphere, whose place in a cell no number tells.
  const double lost[3] = {1e30, 0.5, 0.5};
  for (const double within : {kInf, 1e31})
    EXPECT_NE(nearest_spheres(*set.tree, PointSpan::rows(lost, 1), 1, within, options).value().sphere_id[0], kNothing);
  EXPECT_TRUE(spheres_within(*set.tree, PointSpan::rows(lost, 1), 3.0, options).value().sphere_id.empty());
  set.spheres.cell() = Cell{};
  EXPECT_FALSE(PeriodicImages::of(set.spheres).value());
  const PeriodicSet scattered = set_of({Vec3d{0.5, 0.5, 0.5}, Vec3d{1e30, 0, 0}}, 0.1, cell);
  EXPECT_FALSE(PeriodicImages::of(scattered.spheres).value());
  EXPECT_EQ(select_spheres(scattered.spheres, "within 2 of index 1").value(), (std::vector<std::uint8_t>{0, 1}));
}

// A pair of a sphere and an image of itself is found at both ends, and counts once.
TEST(PeriodicPoints, PairsAreThoseOfAllImages) {
  SplitMix64 random(17);
  for (const Cell& cell : test::periodic_cells()) {
    std::vector<Vec3d> centres;
    for (int i = 0; i < 9; ++i) centres.push_back(test::point_in(cell, random));
    centres.push_back(centres[4]);
    const PeriodicSet set = set_of(centres, 0.1, cell);
    for (const DistanceTo to : {DistanceTo::centre, DistanceTo::surface}) {
      for (const double reach : {0.0, 1.0, 3.0}) {
        const SpherePairs pairs = sphere_pairs(*set.tree, set.spheres, reach, options_of(set, to)).value();
        std::map<std::array<std::int64_t, 2>, std::int64_t> found, expected;
        for (std::size_t k = 0; k < pairs.first.size(); ++k) ++found[{pairs.first[k], pairs.second[k]}];
        for (std::int64_t i = 0; i < set.spheres.size(); ++i) {
          const double limit = to == DistanceTo::surface ? reach + set.spheres.radius(i) : reach;
          for (const wide::NearSphere& near : all_within(set, set.spheres.centre(i), limit, to, 8))
            if (near.id >= i) ++expected[{i, near.id}];
          const std::int64_t own = (expected[{i, i}] - 1) / 2;
          if (own > 0)
            expected[{i, i}] = own;
          else
            expected.erase({i, i});
        }
        EXPECT_EQ(found, expected) << reach;
        if (reach == 3) {
          EXPECT_GT(expected.size(), 10U);
        }
      }
    }
  }
}

}  // namespace
}  // namespace bihive
