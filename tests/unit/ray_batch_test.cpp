// A batch of rays has one state, whatever the order of the calls that fill it.
#include "bihive/wide/ray_batch.h"

#include <gtest/gtest.h>

#include <limits>

namespace bihive {
namespace {

Ray a_ray() {
  Ray ray;
  ray.origin = {1, 2, 3};
  ray.direction = {0, 0, 1};
  ray.t_min = 0.5;
  ray.t_max = 9;
  ray.leaves = 7;
  ray.inside = true;
  return ray;
}

void expect_plain(const Ray& ray) {
  EXPECT_EQ(ray.t_min, 0);
  EXPECT_EQ(ray.t_max, std::numeric_limits<double>::infinity());
  EXPECT_EQ(ray.leaves, kNothing);
  EXPECT_FALSE(ray.inside);
}

void expect_one_state(const RayBatch& rays) {
  const auto count = static_cast<std::size_t>(rays.size());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(rays.origin[axis].size(), count);
    EXPECT_EQ(rays.direction[axis].size(), count);
  }
  EXPECT_TRUE(rays.t_min.empty() || rays.t_min.size() == count);
  EXPECT_TRUE(rays.t_max.empty() || rays.t_max.size() == count);
  EXPECT_TRUE(rays.leaves.empty() || rays.leaves.size() == count);
  EXPECT_TRUE(rays.inside.empty() || rays.inside.size() == count);
}

TEST(RayBatch, grows_after_push_back) {
  RayBatch rays;
  rays.push_back(a_ray());
  rays.resize(1000);
  expect_one_state(rays);
  EXPECT_EQ(rays.span().at(0).leaves, 7);
  EXPECT_TRUE(rays.span().at(0).inside);
  expect_plain(rays.span().at(999));
  EXPECT_EQ(rays.span().at(999).direction.z, 0);
}

TEST(RayBatch, push_back_after_resize) {
  RayBatch rays;
  rays.resize(1000);
  rays.push_back(a_ray());
  expect_one_state(rays);
  ASSERT_EQ(rays.size(), 1001);
  expect_plain(rays.span().at(0));
  expect_plain(rays.span().at(999));
  EXPECT_EQ(rays.span().at(1000).t_max, 9);
  EXPECT_EQ(rays.span().at(1000).leaves, 7);
}

TEST(RayBatch, shrinks_and_is_cleared) {
  RayBatch rays;
  for (int i = 0; i < 10; ++i) rays.push_back(a_ray());
  rays.resize(3);
  expect_one_state(rays);
  rays.clear();
  expect_one_state(rays);
  EXPECT_EQ(rays.size(), 0);
  EXPECT_EQ(rays.span().t_max, nullptr);
  rays.resize(5);
  expect_one_state(rays);
  expect_plain(rays.span().at(4));
}

}  // namespace
}  // namespace bihive
