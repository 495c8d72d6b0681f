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

// Each optional array of the added span may be absent, and so may each of the batch.
TEST(RayBatch, append_gives_every_ray_its_fields) {
  RayBatch given;
  for (int i = 0; i < 3; ++i) given.push_back(a_ray());
  constexpr unsigned kFields = 16;  // a bit for each optional array
  for (unsigned there = 0; there < kFields; ++there)
    for (unsigned added = 0; added < kFields; ++added) {
      RayBatch rays;
      rays.resize(2);
      if ((there & 1) != 0) rays.t_min.assign(2, 0.25);
      if ((there & 2) != 0) rays.t_max.assign(2, 4);
      if ((there & 4) != 0) rays.leaves.assign(2, 5);
      if ((there & 8) != 0) rays.inside.assign(2, 1);
      RaySpan span = given.span();
      if ((added & 1) == 0) span.t_min = nullptr;
      if ((added & 2) == 0) span.t_max = nullptr;
      if ((added & 4) == 0) span.leaves = nullptr;
      if ((added & 8) == 0) span.inside = nullptr;
      rays.append(span);
      expect_one_state(rays);
      ASSERT_EQ(rays.size(), 5);
      const Ray plain;
      const Ray before = rays.span().at(1), after = rays.span().at(4);
      EXPECT_EQ(before.t_min, (there & 1) != 0 ? 0.25 : plain.t_min);
      EXPECT_EQ(before.t_max, (there & 2) != 0 ? 4 : plain.t_max);
      EXPECT_EQ(before.leaves, (there & 4) != 0 ? 5 : plain.leaves);
      EXPECT_EQ(before.inside, (there & 8) != 0);
      EXPECT_EQ(after.origin, a_ray().origin);
      EXPECT_EQ(after.direction, a_ray().direction);
      EXPECT_EQ(after.t_min, (added & 1) != 0 ? 0.5 : plain.t_min);
      EXPECT_EQ(after.t_max, (added & 2) != 0 ? 9 : plain.t_max);
      EXPECT_EQ(after.leaves, (added & 4) != 0 ? 7 : plain.leaves);
      EXPECT_EQ(after.inside, (added & 8) != 0);
      // What neither has takes no memory.
      EXPECT_EQ(rays.leaves.empty(), ((there | added) & 4) == 0);
    }
}

TEST(RayBatch, append_nothing) {
  RayBatch rays;
  rays.append({});
  EXPECT_EQ(rays.size(), 0);
  rays.push_back(a_ray());
  rays.append({});
  expect_one_state(rays);
  EXPECT_EQ(rays.size(), 1);
}

}  // namespace
}  // namespace bihive
