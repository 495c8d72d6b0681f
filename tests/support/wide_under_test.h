// The wide engine in all its forms against the scalar reference, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/render/query/brute_force.h"
#include "bihive/simd/target.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"
#include "support/edge_rays.h"
#include "support/effort.h"
#include "support/world.h"

namespace bihive::test {

inline bool same_bits(const Hit& a, const Hit& b) {
  return a.sphere_id == b.sphere_id && std::memcmp(&a.t, &b.t, sizeof a.t) == 0;
}

inline std::string text_of(const Hit& hit) {
  char line[80];
  std::snprintf(line, sizeof line, "%a of %lld", hit.t, static_cast<long long>(hit.sphere_id));
  return line;
}

inline RayBatch batch_of(const std::vector<Ray>& rays) {
  RayBatch batch;
  for (const Ray& ray : rays) batch.push_back(ray);
  return batch;
}

/// A set of spheres with its reference tree and wide trees of several shapes.
class WideUnderTest {
 public:
  explicit WideUnderTest(const World& world, const std::vector<WideParameters>& shapes = {{}})
      : name_(world.name), spheres_(sphere_set(world)), reference_(build_reference_tree(spheres_, {4, kUnlimited})) {
    for (const WideParameters& shape : shapes) {
      Result<std::shared_ptr<const WideTree>> tree = builder_.build(spheres_, shape);
      BIHIVE_CHECK(tree.ok());
      trees_.push_back(*tree);
    }
  }

  const SphereSet& spheres() const { return spheres_; }
  const WideTree& tree(std::size_t shape = 0) const { return *trees_[shape]; }
  std::int64_t queries() const { return queries_; }
  std::int64_t hits() const { return hits_; }

  /// By brute force if that is fast enough.
  Hit truth(const Ray& ray) const {
    return spheres_.size() <= 64 ? closest_hit(spheres_, ray) : closest_hit(reference_, spheres_, ray);
  }

  /// Every form of query on every target and tree; stops at the first ray that differs. At most `singles` rays are also
  /// asked one by one.
  void check(const RaySpan& rays, std::int64_t singles = 2000) {
    std::vector<Hit> truths(static_cast<std::size_t>(rays.count));
    for (std::int64_t i = 0; i < rays.count; ++i) {
      truths[static_cast<std::size_t>(i)] = truth(rays.at(i));
      hits_ += truths[static_cast<std::size_t>(i)].found() ? 1 : 0;
    }
    for (const std::string& target : targets_under_test()) {
      ASSERT_TRUE(use_target(target).ok());
      for (const auto& tree : trees_) {
        check_many(*tree, rays, RayOrder::blocks, truths, "blocks, " + target);
        check_many(*tree, rays, RayOrder::any, truths, "any order, " + target);
        check_single(*tree, rays.part(0, std::min(singles, rays.count)), truths, "single, " + target);
        check_all_hits(*tree, rays, truths, "all hits, " + target);
        if (testing::Test::HasFatalFailure()) break;
      }
      if (testing::Test::HasFatalFailure()) break;
    }
    ASSERT_TRUE(use_target("").ok());
  }
  void check(const std::vector<Ray>& rays, std::int64_t singles = 2000) {
    const RayBatch batch = batch_of(rays);
    check(batch.span(), singles);
  }

 private:
  static constexpr double kUntouched = -12345.5;

  std::string name_;
  SphereSet spheres_;
  Tree reference_;
  WideBuilder builder_;
  std::vector<std::shared_ptr<const WideTree>> trees_;
  std::int64_t queries_ = 0, hits_ = 0;

  std::string where(const WideTree& tree, const RaySpan& rays, std::int64_t i, const std::string& form) const {
    return text_of(rays.at(i)) + ", number " + std::to_string(i) + " of " + std::to_string(rays.count) + ", " + form +
           ", " + name_ + ", leaves up to " + std::to_string(tree.largest_leaf) + ", levels " +
           std::to_string(tree.levels);
  }

  // The answers are not written beyond the last ray.
  void check_many(const WideTree& tree, const RaySpan& rays, RayOrder order, const std::vector<Hit>& truths,
                  const std::string& form) {
    const auto n = static_cast<std::size_t>(rays.count);
    HitBatch hits;
    hits.t.assign(n + 1, kUntouched);
    hits.sphere_id.assign(n + 1, -77);
    std::vector<std::uint8_t> hidden(n + 1, 77);
    closest_hits(tree, rays, order, hits.span());
    occluded(tree, rays, order, hidden.data());
    queries_ += 2 * rays.count;
    ASSERT_TRUE(hits.t[n] == kUntouched && hits.sphere_id[n] == -77 && hidden[n] == 77) << form << ", " << name_;
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_TRUE(same_bits(hits.at(static_cast<std::int64_t>(i)), truths[i]))
          << text_of(hits.at(static_cast<std::int64_t>(i))) << ", not " << text_of(truths[i]) << ": "
          << where(tree, rays, static_cast<std::int64_t>(i), form);
      ASSERT_EQ(int{hidden[i]}, truths[i].found() ? 1 : 0) << where(tree, rays, static_cast<std::int64_t>(i), form);
    }
  }

  // The first of all hits is the closest one; for as many rays as brute force can answer, all of them are compared. A
  // ray may hit every sphere, so there are fewer rays among many spheres.
  void check_all_hits(const WideTree& tree, const RaySpan& all_rays, const std::vector<Hit>& truths,
                      const std::string& form) {
    constexpr std::int64_t kMostTests = 200000, kMostHits = 300000, kLeastRays = 16;
    const std::int64_t at_most = std::max(kLeastRays, kMostHits / std::max<std::int64_t>(1, spheres_.size()));
    const RaySpan rays = all_rays.part(0, std::min(at_most, all_rays.count));
    std::vector<RayHit> hits{{-1, 0, 0}};  // is overwritten
    all_hits(tree, rays, hits);
    const std::int64_t whole = kMostTests / std::max<std::int64_t>(1, spheres_.size());
    std::size_t next = 0;
    for (std::int64_t i = 0; i < rays.count; ++i) {
      const std::size_t first = next;
      while (next < hits.size() && hits[next].ray == i) ++next;
      const Hit& truth = truths[static_cast<std::size_t>(i)];
      ASSERT_EQ(next > first, truth.found()) << where(tree, rays, i, form);
      if (truth.found()) {
        ASSERT_TRUE(same_bits({hits[first].t, hits[first].sphere_id}, truth)) << where(tree, rays, i, form);
      }
      if (i >= whole) continue;
      std::vector<Hit> expected = every_hit(rays.at(i));
      ASSERT_EQ(next - first, expected.size()) << where(tree, rays, i, form);
      for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_TRUE(same_bits({hits[first + k].t, hits[first + k].sphere_id}, expected[k]))
            << where(tree, rays, i, form);
    }
    ASSERT_EQ(next, hits.size()) << form << ", " << name_;
    queries_ += rays.count;
  }

  // By brute force, in order.
  std::vector<Hit> every_hit(const Ray& ray) const {
    std::vector<Hit> hits;
    if (!is_valid(ray)) return hits;
    const ScaledRay scaled(ray, spheres_);
    for (std::int64_t id = 0; id < spheres_.size(); ++id) {
      const Hit hit{sphere_hit(scaled, spheres_.stored_centre(id), spheres_.stored_radius(id)), id};
      if (hit.t < std::numeric_limits<double>::infinity()) hits.push_back(hit);
    }
    std::sort(hits.begin(), hits.end(),
              [](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : a.sphere_id < b.sphere_id; });
    return hits;
  }

  void check_single(const WideTree& tree, const RaySpan& rays, const std::vector<Hit>& truths,
                    const std::string& form) {
    for (std::int64_t i = 0; i < rays.count; ++i) {
      const Ray ray = rays.at(i);
      const Hit& expected = truths[static_cast<std::size_t>(i)];
      const Hit hit = closest_hit(tree, ray);
      ASSERT_TRUE(same_bits(hit, expected))
          << text_of(hit) << ", not " << text_of(expected) << ": " << where(tree, rays, i, form);
      ASSERT_EQ(occluded(tree, ray), expected.found()) << where(tree, rays, i, form);
    }
    queries_ += 2 * rays.count;
  }
};

}  // namespace bihive::test
