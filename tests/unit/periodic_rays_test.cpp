#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "bihive/geometry/hit_surface.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/math/rng.h"
#include "support/periodic_cells.h"

namespace bihive {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

using test::PeriodicSet;

Hit closest_hit_of(const PeriodicSet& set, const Ray& ray) {
  RayBatch batch;
  batch.push_back(ray);
  Hit hit;
  EXPECT_EQ(set.images->closest_hits(*set.tree, batch.span(), {&hit.t, &hit.sphere_id}), kNothing);
  return hit;
}

// Every image of every sphere, moved by -reach to reach along each periodic vector.
std::vector<RayHit> all_hits_of(const PeriodicSet& set, const ScaledRay& scaled, std::int64_t number, int reach) {
  const SphereSet& spheres = set.spheres;
  std::vector<RayHit> hits;
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    test::for_each_shift(spheres, reach, [&](Vec3d shift) {
      const double t = sphere_hit(scaled, spheres.stored_centre(id) + shift, spheres.stored_radius(id));
      if (t < kUnbounded) hits.push_back({number, t, id});
    });
  std::sort(hits.begin(), hits.end(),
            [](const RayHit& a, const RayHit& b) { return a.t != b.t ? a.t < b.t : a.sphere_id < b.sphere_id; });
  return hits;
}

Vec3f direction_of(SplitMix64& random, int number) {
  Vec3f direction;
  for (int axis = 0; axis < 3; ++axis) direction[axis] = static_cast<float>(2 * random.next_double() - 1);
  if (number % 4 == 0) direction[number / 4 % 3] = 0;        // along a plane of the axes
  if (number % 8 == 0) direction[(number / 4 + 1) % 3] = 0;  // and along an axis
  if (direction == Vec3f{}) direction.x = 1;
  return direction;
}

TEST(PeriodicRays, AgreeWithAllImages) {
  SplitMix64 random(5);
  std::int64_t found = 0, of_images = 0;
  for (const Cell& cell : test::periodic_cells())
    for (const bool is_scattered : {false, true}) {
      std::vector<Vec3d> centres;
      std::vector<double> radii;
      for (int i = 0; i < 9; ++i) {
        centres.push_back(test::point_in(cell, random));
        radii.push_back(i == 8 ? 0 : 0.1 * (1 + i % 3) + (i == 5 ? 2.5 : 0));  // one is larger than most cells
        if (is_scattered && i % 3 == 0)
          centres.back() = centres.back() + double(random.next_below(4)) * cell.vectors[0] - 2.0 * cell.vectors[1];
      }
      centres.push_back(centres[4]), radii.push_back(radii[4]);  // coincide
      centres.push_back(centres[2] + (cell.periodic[0] ? 1.0 : 0.0) * cell.vectors[0]), radii.push_back(radii[2]);
      const PeriodicSet set(centres, radii, cell);
      ASSERT_TRUE(set.images && set.images->check_rays());
      RayBatch rays;
      for (int i = 0; i < 64; ++i) {
        Ray ray;
        ray.origin = to_float(test::point_in(cell, random) + double(i % 3 - 1) * cell.vectors[1]);
        ray.direction = direction_of(random, i);
        ray.t_min = i % 5 == 0 ? -1.5 : i % 7 == 0 ? 0.5 : 0;
        ray.t_max = 4;
        if (i == 17) ray.t_min = 5;  // invalid
        rays.push_back(ray);
      }
      std::vector<RayHit> hits;
      std::vector<double> t(64);
      std::vector<std::int64_t> ids(64);
      std::vector<std::uint8_t> hidden(64);
      ASSERT_EQ(set.images->all_hits(*set.tree, rays.span(), hits), kNothing);
      ASSERT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t.data(), ids.data()}), kNothing);
      ASSERT_EQ(set.images->occluded(*set.tree, rays.span(), hidden.data()), kNothing);
      std::size_t at = 0;
      for (int i = 0; i < 64; ++i) {
        const Ray ray = rays.span().at(i);
        std::vector<RayHit> expected;
        if (is_valid(ray)) expected = all_hits_of(set, ScaledRay(ray, set.spheres.scale()), i, 8);
        for (const RayHit& hit : expected) {
          ASSERT_LT(at, hits.size());
          EXPECT_EQ(hits[at].ray, i);
          EXPECT_EQ(hits[at].t, hit.t);
          EXPECT_EQ(hits[at++].sphere_id, hit.sphere_id);
        }
        const auto k = static_cast<std::size_t>(i);
        EXPECT_EQ(t[k], expected.empty() ? kUnbounded : expected[0].t);
        EXPECT_EQ(ids[k], expected.empty() ? kNothing : expected[0].sphere_id);
        EXPECT_EQ(hidden[k], expected.empty() ? 0 : 1);
        found += static_cast<std::int64_t>(expected.size());
        if (is_valid(ray))
          of_images -= static_cast<std::int64_t>(all_hits_of(set, ScaledRay(ray, set.spheres.scale()), i, 0).size());
      }
      EXPECT_EQ(at, hits.size());
    }
  EXPECT_GT(found, 2000);
  EXPECT_GT(of_images + found, found / 4);  // most hits are of images
}

TEST(PeriodicRays, FarImagesAreAsExact) {
  // A ray past 1,000 cells, along a vector of the cell and beside it.
  const Cell cell{{}, {Vec3d{1, 0, 0}, Vec3d{0.25, 1, 0}, Vec3d{0, 0, 1}}};
  const PeriodicSet set({Vec3d{0.5, 0.5, 0.5}, Vec3d{0.125, 0, 0}}, {0.05, 0.125}, cell);
  Ray ray;
  ray.origin = {-1000, -1000, 0};
  ray.direction = {1, 1, 0};
  ray.t_min = 900;
  const Hit hit = closest_hit_of(set, ray);
  ScaledRay scaled(ray, set.spheres.scale());
  double expected = kUnbounded;
  for (int i = -400; i < 200; ++i)
    for (int j = -110; j < 10; ++j)
      for (const std::int64_t id : {0, 1}) {
        const Vec3d shift = (double(i) * cell.vectors[0] + double(j) * cell.vectors[1]) * set.spheres.scale();
        expected = std::min(expected,
                            sphere_hit(scaled, set.spheres.stored_centre(id) + shift, set.spheres.stored_radius(id)));
      }
  EXPECT_EQ(hit.t, expected);
  EXPECT_TRUE(hit.found());
}

TEST(PeriodicRays, ARayLeavesTheImageThatItStartsOn) {
  // One sphere in a cube: a ray from its surface goes to the next image, not to itself.
  const Cell cell{{}, {Vec3d{4, 0, 0}, Vec3d{0, 4, 0}, Vec3d{0, 0, 4}}};
  const PeriodicSet set({Vec3d{1, 1, 1}}, {1}, cell);
  for (const float image : {0.0F, 12.0F, -400.0F}) {
    Ray ray;
    ray.origin = {2 + image, 1, 1};
    ray.direction = {1, 0, 0};
    ray.leaves = 0;
    EXPECT_EQ(closest_hit_of(set, ray).t, 2);
    ray.direction = {-1, 0, 0};
    ray.inside = true;
    EXPECT_EQ(closest_hit_of(set, ray).t, 2);  // the far side
    ray.direction = {1, 0, 0};
    EXPECT_EQ(closest_hit_of(set, ray).t, 0);  // it ends where it begins
  }
}

TEST(PeriodicRays, ASphereDoesNotCountByItsImageNearestToTheOrigin) {
  // Eighteen equal spheres, of which the tree holds one, and another one.
  const Cell cell{{}, {Vec3d{4, 0, 0}, Vec3d{0, 4, 0}, Vec3d{0, 0, 4}}};
  std::vector<Vec3d> centres(18, Vec3d{1, 1, 1});
  std::vector<double> radii(18, 0.5);
  centres.push_back({3, 1, 1}), radii.push_back(0.25);
  const PeriodicSet set(centres, radii, cell);
  ASSERT_FALSE(set.tree->piles.empty());
  RayBatch rays;
  // The sphere that does not count, and the one that is hit then: of equal ones the lowest id.
  const std::int64_t exclude[] = {kNothing, 0, 1, 17, 18, 99, -5}, first[] = {0, 1, 0, 0, 0, 0, 0};
  for (int i = 0; i < 7; ++i) {
    Ray ray;
    ray.origin = {0, 1, 1};
    ray.direction = {1, 0, 0};
    ray.t_max = 4;
    rays.push_back(ray);
  }
  std::vector<double> t(7);
  std::vector<std::int64_t> ids(7);
  std::vector<RayHit> hits;
  ASSERT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t.data(), ids.data()}, exclude), kNothing);
  ASSERT_EQ(set.images->all_hits(*set.tree, rays.span(), hits, exclude), kNothing);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(t[i], 0.5);
    EXPECT_EQ(ids[i], first[i]);
    // Number 18 is nearest to the origin by an image that the ray does not meet.
    const bool is_met = exclude[i] >= 0 && exclude[i] < 18;
    std::int64_t count = 0;
    for (const RayHit& hit : hits) {
      if (hit.ray != static_cast<std::int64_t>(i)) continue;
      ++count;
      EXPECT_FALSE(is_met && hit.sphere_id == exclude[i]);
    }
    EXPECT_EQ(count, is_met ? 18 : 19) << i;
  }
  // One sphere alone: its next image is hit.
  const PeriodicSet one({Vec3d{1, 1, 1}}, {0.5}, cell);
  const std::int64_t itself[] = {0, 0, 0, 0, 0, 0, 0};
  std::vector<std::uint8_t> hidden(7);
  ASSERT_EQ(one.images->occluded(*one.tree, rays.span(), hidden.data(), itself), kNothing);
  EXPECT_EQ(hidden[0], 0);
  for (double& end : rays.t_max) end = 5;
  ASSERT_EQ(one.images->closest_hits(*one.tree, rays.span(), {t.data(), ids.data()}, itself), kNothing);
  EXPECT_EQ(t[0], 4.5);
  EXPECT_EQ(ids[0], 0);
}

TEST(PeriodicRays, ThoseWithoutAnEndAreTold) {
  const Cell cell{{}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}};
  const PeriodicSet set({Vec3d{0.5, 0.5, 0.5}}, {0.1}, cell);
  RayBatch rays;
  Ray ray;
  ray.origin = {0.5, 0.5, 0.5};
  ray.direction = {1, 0, 0};
  rays.push_back(ray);
  ray.origin = {0, 0, 0};  // in a channel
  rays.push_back(ray);
  double t[2];
  std::int64_t ids[2];
  std::uint8_t hidden[2];
  std::vector<RayHit> hits;
  EXPECT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t, ids}), 1);
  EXPECT_EQ(ids[0], 0);
  EXPECT_EQ(set.images->occluded(*set.tree, rays.span(), hidden), 1);
  EXPECT_EQ(set.images->all_hits(*set.tree, rays.span(), hits), 0);  // it meets one image after the other
  EXPECT_NE(PeriodicImages::ray_without_end(1).message.find("ray 1"), std::string::npos);
  rays.t_max = {3, 1000};
  EXPECT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t, ids}), kNothing);
  EXPECT_EQ(ids[1], kNothing);
  EXPECT_EQ(set.images->all_hits(*set.tree, rays.span(), hits), kNothing);
  EXPECT_EQ(hits.size(), 4U);  // where it starts, and three more
  rays.t_max = {3, 1e9};
  EXPECT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t, ids}), 1);
  rays.t_max = {3, 1};
  rays.t_min = {-kUnbounded, 0};
  EXPECT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t, ids}), 0);
  rays.t_min.clear();
  rays.origin[0] = {1e30F, 0};  // no number tells its cell
  EXPECT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t, ids}), 0);
  rays.direction[0] = {0, 0};  // invalid rays hit nothing
  EXPECT_EQ(set.images->closest_hits(*set.tree, rays.span(), {t, ids}), kNothing);
}

TEST(PeriodicRays, ASlabAndAChainEnd) {
  const PeriodicSet slab({Vec3d{0.5, 0.5, 0.5}}, {0.1},
                         {{}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}, {true, true, false}});
  const PeriodicSet chain({Vec3d{0.5, 0.5, 0.5}}, {0.1}, {{}, {Vec3d{1, 0, 0}, Vec3d{}, Vec3d{}}});
  Ray ray;
  ray.origin = {0, 0, 1000};
  ray.direction = {0, 0, -1};
  EXPECT_FALSE(closest_hit_of(slab, ray).found());
  EXPECT_FALSE(closest_hit_of(chain, ray).found());
  ray.direction = {0.5F, 0.5F, -999.5F};
  EXPECT_EQ(closest_hit_of(slab, ray).sphere_id, 0);
  ray.direction = {17.5F, 3.5F, -999.5F};
  EXPECT_EQ(closest_hit_of(slab, ray).sphere_id, 0);
  EXPECT_FALSE(closest_hit_of(chain, ray).found());
  ray.direction = {17.5F, 0.5F, -999.5F};
  EXPECT_EQ(closest_hit_of(chain, ray).sphere_id, 0);
}

TEST(PeriodicRays, SpheresAllOverAreRefused) {
  const Cell cell{{}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}};
  EXPECT_TRUE(PeriodicSet({Vec3d{}, Vec3d{9, 3, 0}}, {0.1, 0.1}, cell).images->check_rays());
  EXPECT_FALSE(PeriodicSet({Vec3d{}, Vec3d{99, 99, 0}}, {0.1, 0.1}, cell).images->check_rays());
  EXPECT_FALSE(PeriodicSet({Vec3d{}}, {30}, cell).images->check_rays());
}

// The image that was hit is found again by its root alone.
TEST(PeriodicRays, AHitTellsItsImage) {
  SplitMix64 random(23);
  for (const Cell& cell : test::periodic_cells()) {
    std::vector<Vec3d> centres;
    std::vector<double> radii;
    for (int i = 0; i < 9; ++i) centres.push_back(test::point_in(cell, random)), radii.push_back(0.1 * (1 + i % 4));
    const PeriodicSet set(centres, radii, cell);
    const SphereSet& spheres = set.spheres;
    int of_images = 0;
    for (int i = 0; i < 200; ++i) {
      Ray ray{to_float(test::point_in(cell, random)), direction_of(random, i)};
      ray.t_max = 30;
      const Hit hit = closest_hit_of(set, ray);
      if (!hit.found()) continue;
      const ScaledRay scaled(ray, spheres.scale());
      const std::optional<Vec3d> centre = set.images->image_of_hit(scaled, hit.t, hit.sphere_id);
      ASSERT_TRUE(centre);
      const std::optional<HitSurface> surface =
          hit_surface(scaled, hit.t, *centre, spheres.stored_radius(hit.sphere_id));
      ASSERT_TRUE(surface);
      EXPECT_LT(length(surface->position - (scaled.origin + hit.t * scaled.direction)), 1e-12);
      of_images += *centre != spheres.stored_centre(hit.sphere_id);
      EXPECT_FALSE(set.images->image_of_hit(scaled, hit.t * (1 + 0x1p-20), hit.sphere_id));
    }
    EXPECT_GT(of_images, 10);
  }
}

}  // namespace
}  // namespace bihive
