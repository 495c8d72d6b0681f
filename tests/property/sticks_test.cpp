// The roots of a ray and a stick are those of the oracle, on hostile sticks and rays; its ends are spheres, bit for
// bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "bihive/bih/traversal.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/math/rng.h"
#include "bihive/render/query/brute_force.h"
#include "bihive/render/query/reference_engine.h"
#include "bihive/render/query/stick_block.h"
#include "bihive/render/query/stick_engine.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"
#include "bihive/simd/target.h"
#include "support/edge_rays.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/scenes.h"
#include "support/stick_oracle.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

Vec3d unit(SplitMix64& rng) {
  for (;;) {
    const Vec3d v{test::uniform(rng, -1, 1), test::uniform(rng, -1, 1), test::uniform(rng, -1, 1)};
    if (dot(v, v) <= 1 && dot(v, v) > 1e-4) return normalized(v);
  }
}

Vec3d in_float(Vec3d v) {
  return to_double(to_float(v));
}

enum class Kind {
  any,
  long_thin,
  capsule,
  along,
  grazing,
  almost_touching,
  almost_along,
  far,
  one_ball,
  nested,
  aligned
};
constexpr int kKinds = 11;

struct Case {
  Stick stick;
  Ray ray;
};

// Numbers of binary32 in stored units. Most rays are aimed at the stick, some start in it.
Case make_case(Kind kind, std::uint64_t seed) {
  SplitMix64 rng(seed * kKinds + static_cast<std::uint64_t>(kind));
  rng.next();
  const double size = test::log_uniform(rng, 1e-4, 1);
  double r = size * test::log_uniform(rng, 1e-4, 2), other = r;
  if (rng.next_below(3) != 0) other = rng.next_below(4) == 0 ? 0 : r * test::log_uniform(rng, 1e-3, 1e3);
  if (other > 1) other = r;
  if (kind == Kind::long_thin) r = other = size * 1e-4;
  if (kind == Kind::capsule) other = r;
  if (kind == Kind::nested) other = r + size * (1 + test::uniform(rng, -1, 1) * test::log_uniform(rng, 1e-9, 1e-1));
  Vec3d axis = unit(rng);
  if (kind == Kind::aligned) {
    const int along = static_cast<int>(rng.next_below(3));
    for (int k = 0; k < 3; ++k) axis[k] = k == along ? 1 : 0;
  }
  Case made;
  Stick& stick = made.stick;
  stick.a = in_float(unit(rng) * test::uniform(rng, 0, 0.5));
  stick.b = kind == Kind::one_ball ? stick.a : in_float(stick.a + axis * size);
  stick.radius_a = double(static_cast<float>(r));
  stick.radius_b = double(static_cast<float>(other));
  if (rng.next_below(2) == 0) stick = {stick.b, stick.a, stick.radius_b, stick.radius_a};

  // A point near the surface of one of its balls, or beyond an end.
  const double s = test::uniform(rng, -0.1, 1.1);
  const double radius = std::max(0.0, stick.radius_a + s * (stick.radius_b - stick.radius_a));
  const Vec3d centre = stick.a + s * (stick.b - stick.a);
  Vec3d ahead = unit(rng);
  if (kind == Kind::along || kind == Kind::aligned) ahead = axis;
  if (kind == Kind::almost_along) ahead = normalized(axis + unit(rng) * test::log_uniform(rng, 1e-10, 1e-2));
  if (rng.next_below(2) == 0) ahead = -ahead;
  double offset = radius * 1.2 * std::sqrt(rng.next_double());
  if (kind == Kind::grazing) offset = radius * test::uniform(rng, 0.999, 1.001);
  if (kind == Kind::almost_touching)
    offset = radius * (1 + (rng.next_below(2) == 0 ? 1 : -1) * test::log_uniform(rng, 1e-9, 1e-3));
  const bool at_side = kind == Kind::grazing || kind == Kind::almost_touching;
  Vec3d beside = at_side ? cross(ahead, axis) : cross(ahead, unit(rng));
  while (!(dot(beside, beside) > 1e-8)) beside = cross(ahead, unit(rng));
  const Vec3d aim = centre + normalized(beside) * offset;
  double back = rng.next_below(6) == 0 ? -test::uniform(rng, 0, size) : test::log_uniform(rng, size, 3);
  if (kind == Kind::far) back = test::log_uniform(rng, 1, 1e12);
  made.ray.origin = to_float(aim - ahead * back);
  made.ray.direction =
      to_float(kind == Kind::far ? aim - to_double(made.ray.origin) : ahead * test::log_uniform(rng, 1e-6, 1e6));
  return made;
}

std::string text_of(const Case& one) {
  char line[300];
  std::snprintf(line, sizeof line, "stick {{%a, %a, %a}, {%a, %a, %a}, %a, %a}, ", one.stick.a.x, one.stick.a.y,
                one.stick.a.z, one.stick.b.x, one.stick.b.y, one.stick.b.z, one.stick.radius_a, one.stick.radius_b);
  return line + test::text_of(one.ray);
}

template <class Check>
void for_each_case(std::uint64_t of_each, const Check& check) {
  for (int kind = 0; kind < kKinds; ++kind)
    for (std::uint64_t i = 0; i < of_each && !testing::Test::HasFailure(); ++i) {
      const Case one = make_case(static_cast<Kind>(kind), i);
      SCOPED_TRACE("kind " + std::to_string(kind) + ", number " + std::to_string(i) + ": " + text_of(one));
      check(one);
    }
}

TEST(Sticks, RootsAreThoseOfTheOracle) {
  int hits = 0, needed = 0;
  for_each_case(1500, [&](const Case& one) {
    const ScaledRay ray(one.ray, 1);
    const StickRoots roots = stick_roots(ray, one.stick);
    const test::StickOracle oracle(ray, one.stick);
    ASSERT_TRUE(oracle.accepts(roots)) << roots.t_near << " " << roots.t_far << ", oracle "
                                       << double(oracle.roots().t_near) << " " << double(oracle.roots().t_far);
    hits += roots.t_near <= roots.t_far ? 1 : 0;
    needed += oracle.accepts(roots, 0.05L) ? 0 : 1;
  });
  EXPECT_GT(hits, 1500 * kKinds / 2);
  EXPECT_GT(needed, 0) << "the bound is looser than it need be";
}

TEST(Sticks, EndsAreSpheresBitForBit) {
  int ends = 0;
  for_each_case(3000, [&](const Case& one) {
    const ScaledRay ray(one.ray, 1);
    const StickRoots roots = stick_roots(ray, one.stick);
    const auto sphere = [&](double s) {
      return s == 0 ? sphere_roots(ray, one.stick.a, one.stick.radius_a)
                    : sphere_roots(ray, one.stick.b, one.stick.radius_b);
    };
    const auto is_end = [](double s) { return s == 0 || s == 1; };
    // Where the line only touches the ball, rounding may have it miss it.
    if (is_end(roots.s_near) && !std::isnan(sphere(roots.s_near).t_near)) {
      ++ends;
      ASSERT_TRUE(same_bits(roots.t_near, sphere(roots.s_near).t_near));
    }
    if (is_end(roots.s_far) && !std::isnan(sphere(roots.s_far).t_far)) {
      ++ends;
      ASSERT_TRUE(same_bits(roots.t_far, sphere(roots.s_far).t_far));
    }
  });
  EXPECT_GT(ends, 3000);
}

// What drops sticks before the roots never drops one that has them, and drops most rays that pass a stick.
TEST(Sticks, ThatSurelyMissHaveNoRoots) {
  int missed = 0, dropped = 0;
  for_each_case(3000, [&](const Case& one) {
    const ScaledRay ray(one.ray, 1);
    const bool misses = std::isnan(stick_roots(ray, one.stick).t_near);
    ASSERT_TRUE(misses || !surely_misses(ray, one.stick)) << text_of(one);
    // A ray that passes beside it: moved across axis and ray by up to three radii.
    Case beside = one;
    const Vec3d across = cross(to_double(one.ray.direction), one.stick.b - one.stick.a);
    const double extent = length(across);
    if (!(extent > 0)) return;
    const double share = static_cast<double>(missed % 60) / 20;
    const double away = share * std::max(one.stick.radius_a, one.stick.radius_b);
    beside.ray.origin = to_float(to_double(one.ray.origin) + (away / extent) * across);
    const ScaledRay passing(beside.ray, 1);
    const bool has_none = std::isnan(stick_roots(passing, one.stick).t_near);
    ASSERT_TRUE(has_none || !surely_misses(passing, one.stick)) << text_of(beside);
    ++missed;
    dropped += surely_misses(passing, one.stick) ? 1 : 0;
  });
  EXPECT_GT(dropped, missed / 10);
}

TEST(Sticks, WithoutASideAreTheirLargerBall) {
  for (std::uint64_t i = 0; i < 3000; ++i) {
    Case one = make_case(Kind::capsule, i);
    if (i % 2 == 0)
      one.stick.b = one.stick.a;
    else
      one.stick.radius_b = one.stick.radius_a + length(one.stick.b - one.stick.a) * (1 + 1e-9);
    const ScaledRay ray(one.ray, 1);
    const StickRoots roots = stick_roots(ray, one.stick);
    const SphereRoots ball = sphere_roots(ray, one.stick.b, one.stick.radius_b);
    ASSERT_TRUE(same_bits(roots.t_near, ball.t_near) && same_bits(roots.t_far, ball.t_far)) << text_of(one);
  }
}

TEST(Sticks, OfRadiusZeroAreNeverHit) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Case one = make_case(Kind::aligned, i);
    one.stick.radius_a = one.stick.radius_b = 0;
    one.ray.origin = to_float(0.5 * (one.stick.a + one.stick.b) - to_double(one.ray.direction));
    ASSERT_TRUE(std::isnan(stick_roots(ScaledRay(one.ray, 1), one.stick).t_near)) << text_of(one);
  }
}

// Powers of two change no bit, so nothing overflows or underflows on the way.
TEST(Sticks, AnyUnitOfLength) {
  for_each_case(600, [&](const Case& one) {
    const StickRoots roots = stick_roots(ScaledRay(one.ray, 1), one.stick);
    for (const double scale : {0x1p-100, 0x1p-60, 0x1p100}) {
      ScaledRay ray(one.ray, scale);
      const Stick& stick = one.stick;
      const StickRoots scaled =
          stick_roots(ray, {scale * stick.a, scale * stick.b, scale * stick.radius_a, scale * stick.radius_b});
      ASSERT_TRUE(same_bits(scaled.t_near, roots.t_near) && same_bits(scaled.s_near, roots.s_near)) << scale;
      ASSERT_TRUE(same_bits(scaled.t_far, roots.t_far) && same_bits(scaled.s_far, roots.s_far)) << scale;
    }
  });
}

TEST(Sticks, NormalsPointAwayFromTheAxisAndChangeEvenlyAcrossSeams) {
  for_each_case(600, [&](const Case& one) {
    const ScaledRay ray(one.ray, 1);
    const StickRoots roots = stick_roots(ray, one.stick);
    if (std::isnan(roots.t_near) || one.ray.t_min > 0) return;
    const Vec3d normal = stick_normal(ray, one.stick, roots.t_near);
    ASSERT_NEAR(length(normal), 1, 1e-12);
    ASSERT_LE(dot(normal, normalized(ray.direction)), 1e-3);
  });
  // Around the seam of a capsule along x the normal has no step.
  const Stick stick{{0, 0, 0}, {1, 0, 0}, 0.25, 0.25};
  Vec3d before{};
  for (int i = -1000; i <= 1000; ++i) {
    Ray ray;
    ray.origin = {static_cast<float>(i) * 1e-5f, 0, 2};
    ray.direction = {0, 0, -1};
    const ScaledRay scaled(ray, 1);
    const Vec3d normal = stick_normal(scaled, stick, stick_roots(scaled, stick).t_near);
    if (i > -1000) {
      ASSERT_LT(length(normal - before), 1e-4);
    }
    before = normal;
  }
}

StickHit hit_from_surface(const Stick& stick, const Stick& left, Vec3d origin, Vec3d direction, bool inside) {
  Ray ray;
  ray.origin = to_float(origin);
  ray.direction = to_float(direction);
  ray.inside = inside;
  StickRay of{ScaledRay(ray, 1)};
  of.leaves_stick = true;
  of.left = left;
  return stick_hit(of, stick);
}

TEST(Sticks, ARayThatExitsOneNeverMeetsItAgain) {
  int inside = 0;
  for_each_case(600, [&](const Case& one) {
    const ScaledRay ray(one.ray, 1);
    const StickRoots roots = stick_roots(ray, one.stick);
    if (std::isnan(roots.t_near) || !(one.stick.radius_a > 0 && one.stick.radius_b > 0)) return;
    const Vec3d place = ray.origin + roots.t_near * ray.direction;
    const Stick turned{one.stick.b, one.stick.a, one.stick.radius_b, one.stick.radius_a};
    for (const Stick& same : {one.stick, turned}) {
      ASSERT_EQ(hit_from_surface(one.stick, same, place, -ray.direction, false).t, kInfinity);
      const StickHit across = hit_from_surface(one.stick, same, place, ray.direction, true);
      if (across.t < kInfinity) ++inside;
    }
  });
  EXPECT_GT(inside, 600);
}

// Sticks between random spheres: bonds of a chain, and between any two. Then round cones and points of arrows, which
// begin at a sphere; some of the same radius.
StickSet chain_of(SphereSet& spheres, double radius, SplitMix64& rng) {
  std::vector<SpherePair> pairs;
  const auto count = static_cast<std::int32_t>(spheres.size());
  for (std::int32_t i = 0; i + 1 < count; ++i) pairs.push_back({i, i + 1});
  for (int i = 0; i < 20; ++i)
    pairs.push_back({static_cast<std::int32_t>(rng.next_below(std::uint64_t(count))),
                     static_cast<std::int32_t>(rng.next_below(std::uint64_t(count)))});
  pairs.push_back(pairs.front());  // coincident
  Result<StickSet> made = StickSet::between(spheres, pairs, radius);
  EXPECT_TRUE(made.ok());
  std::vector<OwnStick> cones;
  for (int i = 0; i < 20; ++i) {
    const auto sphere = static_cast<std::int32_t>(rng.next_below(std::uint64_t(count)));
    const auto other = static_cast<std::int64_t>(rng.next_below(std::uint64_t(count)));
    const double at_sphere = i % 3 == 0 && spheres.radius(sphere) > 0 ? spheres.radius(sphere) : radius;
    cones.push_back({spheres.local_centre(sphere), spheres.local_centre(other), at_sphere,
                     i % 2 == 0 ? 0 : radius * rng.next_double(), sphere});
  }
  EXPECT_TRUE(made->add(spheres, cones).ok());
  return std::move(*made);
}

// Every sphere and every stick, one after the other.
Hit brute_closest(const SphereSet& spheres, const StickSet& sticks, const Ray& ray) {
  Ray of_spheres = ray;
  of_spheres.leaves = left_sphere(spheres, sticks, ray.leaves, ray.inside);
  Hit best = closest_hit(spheres, of_spheres);
  if (!is_valid(ray)) return best;
  const StickRay of = stick_ray(ray, spheres, sticks);
  for (std::int64_t stick = 0; stick < sticks.size(); ++stick) {
    const StickHit hit = stick_hit(of, sticks.stored(spheres, stick));
    best.keep_nearer(hit.t, spheres.total_size() + half_of(stick, hit));
  }
  return best;
}

// Every sphere and every stick that the ray meets, by t, then id.
std::vector<Hit> brute_all(const SphereSet& spheres, const StickSet& sticks, const Ray& ray) {
  std::vector<Hit> all;
  if (!is_valid(ray)) return all;
  Ray of_spheres = ray;
  of_spheres.leaves = left_sphere(spheres, sticks, ray.leaves, ray.inside);
  const ScaledRay scaled(of_spheres, spheres);
  for (std::int64_t id = 0; id < spheres.total_size(); ++id)
    all.push_back({sphere_hit(scaled, spheres.stored_centre(id), spheres.stored_radius(id)), id});
  const StickRay of = stick_ray(ray, spheres, sticks);
  for (std::int64_t stick = 0; stick < sticks.total_size(spheres); ++stick) {
    const StickHit hit = stick_hit(of, sticks.stored(spheres, stick));
    all.push_back({hit.t, spheres.total_size() + half_of(stick, hit)});
  }
  all.erase(std::remove_if(all.begin(), all.end(), [](const Hit& hit) { return !(hit.t < kInfinity); }), all.end());
  std::sort(all.begin(), all.end(),
            [](const Hit& a, const Hit& b) { return std::tie(a.t, a.sphere_id) < std::tie(b.t, b.sphere_id); });
  return all;
}

// `all`: of many rays; those of ray i must be the truths.
void expect_all(const std::vector<RayHit>& all, std::int64_t ray, const std::vector<Hit>& truths) {
  const auto is_before = [](const RayHit& hit, std::int64_t number) { return hit.ray < number; };
  const auto first = std::lower_bound(all.begin(), all.end(), ray, is_before);
  ASSERT_EQ(std::lower_bound(first, all.end(), ray + 1, is_before) - first, std::ptrdiff_t(truths.size()));
  for (std::size_t k = 0; k < truths.size(); ++k) {
    ASSERT_EQ(first[std::ptrdiff_t(k)].sphere_id, truths[k].sphere_id);
    ASSERT_TRUE(same_bits(first[std::ptrdiff_t(k)].t, truths[k].t));
  }
}

TEST(Sticks, TheTreeLosesNothing) {
  int on_sticks = 0;
  for (const test::World& world : test::degenerate_worlds()) {
    if (world.size() < 2) continue;
    SCOPED_TRACE(world.name);
    SphereSet spheres = test::sphere_set(world);
    SplitMix64 rng(71);
    for (const double share : {0x1p-10, 0x1p-4, 0.5}) {
      const StickSet sticks = chain_of(spheres, share * spheres.inverse_scale(), rng);
      auto tree = std::make_shared<const Tree>(build_reference_tree(spheres, BuildParameters()));
      test::EdgeRays rays(world, 72);
      RayBatch batch;
      std::vector<Hit> truths;
      std::vector<std::vector<Hit>> all_truths;
      for (int i = 0; i < 150; ++i) {
        Ray ray = rays.next();
        if (i % 3 == 0)
          ray.leaves =
              spheres.total_size() + static_cast<std::int64_t>(rng.next_below(2 * std::uint64_t(sticks.size())));
        truths.push_back(brute_closest(spheres, sticks, ray));
        all_truths.push_back(brute_all(spheres, sticks, ray));
        on_sticks += truths.back().sphere_id >= spheres.total_size() ? 1 : 0;
        batch.push_back(ray);
      }
      const auto of_spheres = std::make_shared<ReferenceEngine>(spheres, tree);
      const auto check = [&](const StickEngine& engine) {
        HitBatch hits;
        hits.resize(batch.size());
        std::vector<std::uint8_t> hidden(static_cast<std::size_t>(batch.size()));
        engine.closest_hits(batch.span(), RayOrder::any, hits.span());
        engine.occluded(batch.span(), RayOrder::any, hidden.data());
        std::vector<RayHit> all;
        engine.all_hits(batch.span(), RayOrder::any, all);
        for (std::size_t i = 0; i < truths.size(); ++i) {
          const auto number = static_cast<std::int64_t>(i);
          const Ray ray = batch.span().at(number);
          const Hit& truth = truths[i];
          const Hit found = engine.closest_hit(ray);
          ASSERT_TRUE(found.sphere_id == truth.sphere_id && same_bits(found.t, truth.t))
              << found.t << " of " << found.sphere_id << ", not " << truth.t << " of " << truth.sphere_id << ": "
              << test::text_of(ray);
          ASSERT_EQ(engine.occluded(ray), truth.found()) << test::text_of(ray);
          ASSERT_EQ(hits.sphere_id[i], truth.sphere_id);
          ASSERT_TRUE(same_bits(hits.t[i], truth.t));
          ASSERT_EQ(hidden[i] != 0, truth.found());
          ASSERT_NO_FATAL_FAILURE(expect_all(all, number, all_truths[i]));
        }
      };
      ASSERT_NO_FATAL_FAILURE(check(StickEngine(spheres, sticks, of_spheres, nullptr, /*by_vectors=*/false)));
      const StickEngine by_vectors(spheres, sticks, of_spheres, nullptr, /*by_vectors=*/true);
      for (const std::string& target : test::targets_under_test()) {
        SCOPED_TRACE(target);
        ASSERT_TRUE(use_target(target).ok());
        ASSERT_NO_FATAL_FAILURE(check(by_vectors));
      }
      ASSERT_TRUE(use_target("").ok());
    }
  }
  EXPECT_GT(on_sticks, 1000);
}

// A ray, and others that are nearly like it: closer and closer, some the same.
std::vector<Ray> neighbours_of(const Ray& ray, SplitMix64& rng) {
  std::vector<Ray> rays{ray};
  const double reach = length(to_double(ray.direction));
  const double origin_step = test::log_uniform(rng, 1e-8, 0.1), step = test::log_uniform(rng, 1e-8, 0.1);
  const bool common_origin = rng.next_below(2) == 0;
  while (std::ssize(rays) < StickBlock::kRays) {
    Ray near = ray;
    const Vec3d origin = to_double(ray.origin);
    if (!common_origin) near.origin = to_float(origin + origin_step * (1 + length(origin)) * unit(rng));
    if (rng.next_below(8) != 0) near.direction = to_float(to_double(ray.direction) + step * reach * unit(rng));
    if (rng.next_below(8) == 0)
      near.t_max = near.t_min + static_cast<float>(rng.next_double() / std::max(reach, 1e-30));
    rays.push_back(near);
  }
  return rays;
}

// The rays of a block meet every stick that each of them hits, with the bits of its roots, in both kinds of queries.
TEST(Sticks, NeighbouringRaysMeetTheirSticksTogether) {
  std::int64_t blocks = 0, tried = 0, hits_in_blocks = 0, dropped = 0;
  for (const test::World& world : test::degenerate_worlds()) {
    if (world.size() < 2) continue;
    SCOPED_TRACE(world.name);
    SphereSet spheres = test::sphere_set(world);
    SplitMix64 rng(81);
    const StickSet sticks = chain_of(spheres, 0x1p-5 * spheres.inverse_scale(), rng);
    std::vector<Aabb> boxes;
    for (std::int64_t k = 0; k < sticks.size(); ++k) boxes.push_back(sticks.stored_box(spheres, k));
    const StickTree tree(boxes);
    const auto of_spheres = std::make_shared<ReferenceEngine>(
        spheres, std::make_shared<const Tree>(build_reference_tree(spheres, BuildParameters())));
    const StickEngine engine(spheres, sticks, of_spheres, nullptr, /*by_vectors=*/true);
    test::EdgeRays edge_rays(world, 82);
    for (int i = 0; i < test::at_least(3, 12); ++i) {
      std::vector<Ray> rays = neighbours_of(edge_rays.next(), rng);
      if (i % 3 == 0)
        for (Ray& ray : rays)
          if (rng.next_below(2) == 0)
            ray.leaves =
                static_cast<std::int64_t>(rng.next_below(std::uint64_t(spheres.total_size() + 2 * sticks.size())));
      RayBatch batch;
      std::vector<Hit> truths;
      for (const Ray& ray : rays) {
        batch.push_back(ray);
        truths.push_back(brute_closest(spheres, sticks, ray));
      }
      for (const std::string& target : test::targets_under_test()) {
        SCOPED_TRACE(target);
        ASSERT_TRUE(use_target(target).ok());
        HitBatch hits;
        hits.resize(batch.size());
        std::vector<std::uint8_t> hidden(rays.size());
        engine.closest_hits(batch.span(), RayOrder::blocks, hits.span());
        engine.occluded(batch.span(), RayOrder::blocks, hidden.data());
        for (std::size_t k = 0; k < rays.size(); ++k) {
          ASSERT_EQ(hits.sphere_id[k], truths[k].sphere_id) << test::text_of(rays[k]);
          ASSERT_TRUE(same_bits(hits.t[k], truths[k].t)) << test::text_of(rays[k]);
          ASSERT_EQ(hidden[k] != 0, truths[k].found()) << test::text_of(rays[k]);
        }

        // The traversal by itself.
        StickBlock block;
        block.clear();
        std::vector<ScaledRay> in_block;
        for (const Ray& ray : rays)
          if (is_valid(ray)) {
            in_block.emplace_back(ray, spheres.scale());
            block.add(in_block.back(), kInfinity);
          }
        struct Met final : StickBlockTests {
          std::vector<std::uint64_t> near;
          std::vector<StickRoots> roots;  // of 64 rays each
          const SphereSet& spheres;
          const StickSet& sticks;

          Met(const SphereSet& of_spheres, const StickSet& of_sticks)
              : near(std::size_t(of_sticks.size())), roots(64 * near.size()), spheres(of_spheres), sticks(of_sticks) {}
          Stick stick(std::int64_t index) const override { return sticks.stored(spheres, index); }
          void test(std::int64_t index, const Stick& tested, std::uint64_t rays_near,
                    const StickBlockRoots& found) override {
            EXPECT_TRUE(tested == stick(index));
            near[std::size_t(index)] = rays_near;
            for (std::size_t i = 0; i < 64 && found.has_side; ++i)
              if ((rays_near >> i & 1) != 0) roots[64 * std::size_t(index) + i] = found.of_ray(i);
          }
        } met(spheres, sticks);
        ++tried;
        if (!traverse(tree, block, kPadOfSticks, met)) continue;
        ++blocks;
        for (std::int64_t k = 0; k < sticks.size(); ++k)
          for (std::size_t lane = 0; lane < in_block.size(); ++lane) {
            const Stick stick = sticks.stored(spheres, k);
            const bool is_near = (met.near[std::size_t(k)] >> lane & 1) != 0;
            if (stick_hit(StickRay{in_block[lane]}, stick).t < kInfinity) {
              ASSERT_TRUE(is_near);
              ++hits_in_blocks;
            }
            dropped += is_near ? 0 : 1;
            const Vec3d axis = stick.b - stick.a;
            const double widening = stick.radius_b - stick.radius_a;
            if (!is_near || !(dot(axis, axis) - widening * widening > 0)) continue;
            const StickRoots expected = stick_roots(in_block[lane], stick);
            const StickRoots& found = met.roots[64 * std::size_t(k) + lane];
            ASSERT_TRUE(same_bits(found.t_near, expected.t_near) && same_bits(found.t_far, expected.t_far) &&
                        found.s_near == expected.s_near && found.s_far == expected.s_far);
          }
      }
    }
  }
  ASSERT_TRUE(use_target("").ok());
  EXPECT_GT(blocks, tried / 4);
  EXPECT_GT(hits_in_blocks, 3000 / test::ray_share());
  EXPECT_GT(dropped, hits_in_blocks);
}

// Copies of a set have the sticks, and the stubs, of a set that holds the copies.
TEST(Sticks, OfCopiesAreThoseOfAWholeSet) {
  const std::array<Vec3d, 3> vectors{Vec3d{2, 0, 0.25}, Vec3d{-0.5, 2, 0}, Vec3d{0, 0, 3}};
  const std::array<std::int32_t, 3> counts{3, 2, 2};
  SplitMix64 rng(76);
  test::World world;
  for (int i = 0; i < 6; ++i)
    world.add(2 * rng.next_double(), 2 * rng.next_double(), 3 * rng.next_double(), 0.1 + 0.2 * rng.next_double());
  SphereSet few = test::sphere_set(world);
  Cell cell;
  cell.vectors = vectors;
  few.cell() = cell;
  ASSERT_TRUE(few.replicate(vectors, counts).ok());
  const std::vector<ImagePair> pairs{{{0, 1}, {}}, {{1, 2}, {}}, {{3, 4}, {1, 0, 0}}, {{5, 5}, {0, -1, 1}}};
  Result<StickSet> of_few = StickSet::between(few, pairs, 0.07);
  ASSERT_TRUE(of_few.ok());
  ASSERT_TRUE(
      of_few->add(few, {{few.local_centre(2), {3, 1, 5}, 0.1, 0, 2}, {{1, 1, 1}, {1, -2, 4}, 0.05, 0.15, 4}}).ok());
  Scene scene;
  scene.spheres = few;
  scene.sticks = *of_few;
  int on_sticks[2] = {0, 0};
  for (const Engine kind : {Engine::reference, Engine::wide, Engine::brute}) {
    const Result<Tracer> tracer = Tracer::build(scene, kind, {}, 1);
    ASSERT_TRUE(tracer.ok());
    RayBatch batch;
    for (int i = 0; i < 4000; ++i) {
      Ray ray;
      Vec3d from, to;
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = 12 * rng.next_double() - 3;
        to[axis] = 6 * rng.next_double();
      }
      ray.origin = to_float(from);
      ray.direction = to_float(to - from);
      if (i % 4 == 0)
        ray.leaves =
            few.total_size() + static_cast<std::int64_t>(rng.next_below(2 * std::uint64_t(of_few->total_size(few))));
      // One after the other, copies by the spheres of their ids.
      Ray of_spheres = ray;
      of_spheres.leaves = left_sphere(few, *of_few, ray.leaves, ray.inside);
      Hit truth;
      const ScaledRay scaled(of_spheres, few);
      for (std::int64_t id = 0; id < few.total_size(); ++id)
        truth.keep_nearer(sphere_hit(scaled, few.stored_centre(id), few.stored_radius(id)), id);
      const StickRay of = stick_ray(ray, few, *of_few);
      for (std::int64_t copy = 0; copy < few.images().count(); ++copy)
        for (std::int64_t k = 0; k < of_few->size(); ++k) {
          const std::int64_t stick = copy * of_few->size() + k;
          Stick here = of_few->stored(few, k);
          const Vec3d shift = few.scale() * few.images().shift(copy);
          for (Vec3d* const end : {&here.a, &here.b})
            if (copy > 0) *end = to_double(to_float(*end + shift));
          const StickHit hit = stick_hit(of, here);
          truth.keep_nearer(hit.t, few.total_size() + half_of(stick, hit));
        }
      batch.push_back(ray);
      const Hit found = tracer->closest_hit(ray);
      ASSERT_EQ(found.sphere_id, truth.sphere_id) << i;
      ASSERT_TRUE(same_bits(found.t, truth.t));
      ASSERT_EQ(tracer->occluded(ray), truth.found());
      if (truth.sphere_id < few.total_size()) continue;
      const std::int64_t half = truth.sphere_id - few.total_size();
      ++on_sticks[half / 2 >= of_few->size() ? 1 : 0];
      ASSERT_EQ(shown_sphere(scene, truth.sphere_id) / few.size(), half / 2 / of_few->size());
    }
    std::vector<RayHit> all;
    tracer->all_hits(batch.span(), RayOrder::any, all);
    for (std::int64_t i = 0; i < batch.size(); ++i)
      ASSERT_NO_FATAL_FAILURE(expect_all(all, i, brute_all(few, *of_few, batch.span().at(i))));
  }
  EXPECT_GT(on_sticks[0], 100);
  EXPECT_GT(on_sticks[1], 1000);
}

// Ball and stick of the same radius share a surface: no ray that starts on one of them meets the other there. (Within
// the rounding of origins to binary32 around the seam it may.)
TEST(Sticks, LicoriceHasNoShadowsOfItsOwn) {
  const test::World world = [] {
    test::World made;
    made.add(0.1, 0.2, 0.3, 0.15);
    made.add(1.3, 0.5, 0.1, 0.15);
    made.add(1.9, -0.7, 0.4, 0.15);
    return made;
  }();
  const SphereSet spheres = test::sphere_set(world);
  Result<StickSet> sticks = StickSet::between(spheres, {{0, 1}, {1, 2}}, double(world.r[0]));
  ASSERT_TRUE(sticks.ok());
  auto tree = std::make_shared<const Tree>(build_reference_tree(spheres, BuildParameters()));
  const StickEngine engine(spheres, *sticks, std::make_shared<ReferenceEngine>(spheres, tree), nullptr,
                           /*by_vectors=*/true);
  SplitMix64 rng(73);
  int starts[2] = {0, 0};
  for (int i = 0; i < 40000; ++i) {
    // Around the first ball, whose seam is the circle where the first stick's side begins.
    Ray ray;
    const Vec3d axis = normalized(spheres.centre(1) - spheres.centre(0));
    const Vec3d side = normalized(cross(axis, unit(rng)));
    const Vec3d place =
        spheres.centre(0) + side * 0.15 + axis * (i % 2 == 0 ? 1 : -1) * test::log_uniform(rng, 1e-6, 1e-2);
    const Vec3d ahead = normalized(unit(rng) * 0.5 - side);
    ray.origin = to_float(place - ahead * 0.7);
    ray.direction = to_float(ahead);
    const Hit hit = engine.closest_hit(ray);
    if (hit.sphere_id != 0 && hit.sphere_id != 3) continue;
    Ray away;
    away.origin = to_float(to_double(ray.origin) + hit.t * to_double(ray.direction));
    away.leaves = hit.sphere_id;
    const bool on_sphere = hit.sphere_id < spheres.total_size();
    const ScaledRay scaled(ray, spheres.scale());
    const Vec3d normal = on_sphere ? normalized(to_double(away.origin) - spheres.centre(hit.sphere_id))
                                   : stick_normal(scaled, sticks->stored(spheres, 0), hit.t);
    Vec3d direction = unit(rng);
    if (dot(direction, normal) < 0) direction = -direction;
    away.direction = to_float(direction);
    if (!(dot(to_double(away.direction), normal) > 1e-3)) continue;
    // The second stick is farther away.
    ++starts[on_sphere ? 0 : 1];
    const Hit again = engine.closest_hit(away);
    ASSERT_TRUE(!again.found() || again.t > 0.2)
        << again.t << " of " << again.sphere_id << " from " << hit.sphere_id << ": " << test::text_of(away);
  }
  EXPECT_GT(starts[0], 1000);
  EXPECT_GT(starts[1], 1000);
}

}  // namespace
}  // namespace bihive
