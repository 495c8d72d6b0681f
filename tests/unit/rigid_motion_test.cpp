// Frames laid over each other.
#include "bihive/job/rigid_motion.h"

#include <gtest/gtest.h>

#include <vector>

#include "bihive/math/rng.h"
#include "bihive/scene/turn.h"

namespace bihive {
namespace {

std::vector<Vec3d> cloud(std::uint64_t seed, int count) {
  SplitMix64 random(seed);
  const auto uniform = [&random] { return 20 * random.next_double() - 10; };
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) points.push_back({uniform(), uniform(), uniform()});
  return points;
}

RigidMotion some_motion(double degrees) {
  Camera camera;
  const Vec3d axis = normalized(Vec3d{1, -2, 0.5});
  RigidMotion motion;
  const auto turned = [&](Vec3d v) {
    camera.eye = v;
    camera.look_at = {};
    return turned_about(camera, axis, degrees).eye;
  };
  const Vec3d x = turned({1, 0, 0}), y = turned({0, 1, 0}), z = turned({0, 0, 1});
  motion.rows = {Vec3d{x.x, y.x, z.x}, Vec3d{x.y, y.y, z.y}, Vec3d{x.z, y.z, z.z}};
  motion.shift = {3, 100, -7};
  return motion;
}

TEST(RigidMotion, ASuperpositionFindsTheMotion) {
  for (const double degrees : {0.0, 1e-3, 40.0, 90.0, 179.0, 180.0, -120.0})
    for (const int count : {3, 4, 50}) {
      const RigidMotion motion = some_motion(degrees);
      const std::vector<Vec3d> still = cloud(5, count);
      std::vector<Vec3d> moving;
      for (const Vec3d point : still) moving.push_back(motion(point));
      const RigidMotion back = superposition(moving, still);
      for (std::size_t i = 0; i < still.size(); ++i) EXPECT_LT(length(back(moving[i]) - still[i]), 1e-10) << degrees;
    }
}

TEST(RigidMotion, IsARotationAlsoWhereAMirrorWouldFitBetter) {
  const std::vector<Vec3d> still = cloud(9, 30);
  std::vector<Vec3d> moving = still;
  for (Vec3d& point : moving) point.x = -point.x;
  const RigidMotion motion = superposition(moving, still);
  EXPECT_NEAR(dot(motion.rows[0], cross(motion.rows[1], motion.rows[2])), 1, 1e-12);
  for (const Vec3d row : motion.rows) EXPECT_NEAR(length(row), 1, 1e-12);
}

TEST(RigidMotion, NoOtherRotationIsCloser) {
  const std::vector<Vec3d> still = cloud(1, 20), moving = cloud(2, 20);
  const RigidMotion best = superposition(moving, still);
  Vec3d mean;
  for (const Vec3d point : still) mean = mean + point / static_cast<double>(still.size());
  // With one more rotation about the mean.
  const auto error_of = [&](const RigidMotion& turn) {
    double sum = 0;
    for (std::size_t i = 0; i < still.size(); ++i) {
      const Vec3d apart = turn.turned(best(moving[i]) - mean) + mean - still[i];
      sum += dot(apart, apart);
    }
    return sum;
  };
  for (const double degrees : {0.5, -0.5, 3.0, 180.0}) EXPECT_GT(error_of(some_motion(degrees)), error_of({}));
}

TEST(RigidMotion, SpheresAndCellMove) {
  SphereSet spheres = *SphereSet::from_world(std::vector<double>{1, 2}, {0, 0}, {0, 0}, {1, 0.5});
  spheres.cell() = Cell{{1, 0, 0}, {Vec3d{4, 0, 0}, Vec3d{0, 5, 0}, Vec3d{0, 0, 6}}};
  RigidMotion motion;  // x becomes y
  motion.rows = {Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}};
  motion.shift = {0, 0, 10};
  ASSERT_TRUE(move_spheres(spheres, motion));
  EXPECT_EQ(spheres.centre(1), (Vec3d{0, 2, 10}));
  EXPECT_EQ(spheres.radius(1), 0.5);
  EXPECT_EQ(spheres.cell()->origin, (Vec3d{0, 1, 10}));
  EXPECT_EQ(spheres.cell()->vectors[0], (Vec3d{0, 4, 0}));
}

}  // namespace
}  // namespace bihive
