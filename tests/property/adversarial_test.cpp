// Hill climbing, in units in the last place, towards the rays on which two answers could differ: silhouettes, equal t,
// and hits that lie farther outside their box than any other. On every ray of the way, the tree must give brute force's
// bits, and the oracle must accept the answer.
//
// BIHIVE_LONG=N in the environment climbs from N times as many starts (scripts/verify).
// ctest: kernel
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/render/query/brute_force.h"
#include "support/edge_rays.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/oracle.h"
#include "support/wide_under_test.h"

namespace bihive {
namespace {

// The wide engine gets one ray in this many as well.
const std::int64_t kWideShare = std::max<std::int64_t>(1, test::ray_share() / 2);

/// A world with its trees, and the largest share of the padding that any hit has used.
class Arena {
 public:
  explicit Arena(const test::World& world)
      : world_(world), spheres_(test::sphere_set(world)), oracle_(world_), wide_(world_) {
    for (const std::int64_t max_prims : {1, 8})
      trees_.push_back(build_reference_tree(spheres_, {max_prims, kUnlimited}));
  }

  const test::World& world() const { return world_; }
  const SphereSet& spheres() const { return spheres_; }
  const test::Oracle& oracle() const { return oracle_; }
  double most_padding_used() const { return most_padding_used_; }
  int rays() const { return rays_; }

  void check(const Ray& ray) {
    ++rays_;
    const Hit truth = closest_hit(spheres_, ray);
    for (const Tree& tree : trees_) {
      const Hit found = closest_hit(tree, spheres_, ray);
      ASSERT_TRUE(found.sphere_id == truth.sphere_id && std::memcmp(&found.t, &truth.t, sizeof truth.t) == 0)
          << found.t << " of " << found.sphere_id << ", not " << truth.t << " of " << truth.sphere_id << ": "
          << test::text_of(ray);
      ASSERT_EQ(occluded(tree, spheres_, ray), truth.found()) << test::text_of(ray);
    }
    ASSERT_TRUE(oracle_.accepts(ray, oracle_.encounters(ray), truth.t, truth.sphere_id))
        << truth.t << " of " << truth.sphere_id << ": " << test::text_of(ray);
    if (truth.found()) most_padding_used_ = std::max(most_padding_used_, padding_used(ray, truth));
    if (rays_ % kWideShare == 0) for_wide_.push_back(ray);
  }

  /// Gives the wide engine the rays that were checked since the last call.
  void check_wide() {
    wide_.check(for_wide_);
    for_wide_.clear();
  }

  /// The distance of the hit outside the sphere's box, in paddings.
  double padding_used(const Ray& ray, const Hit& hit) const {
    const ScaledRay scaled(ray, spheres_);
    const Aabb box = spheres_.stored_box(hit.sphere_id);
    long double outside = -HUGE_VALL;
    for (int axis = 0; axis < 3; ++axis) {
      const long double place = scaled.origin[axis] + static_cast<long double>(hit.t) * scaled.direction[axis];
      outside = std::max({outside, place - box.hi[axis], box.lo[axis] - place});
    }
    return static_cast<double>(outside / Slabs(scaled).pad());
  }

 private:
  test::World world_;
  SphereSet spheres_;
  test::Oracle oracle_;
  std::vector<Tree> trees_;
  test::WideUnderTest wide_;
  std::vector<Ray> for_wide_;
  double most_padding_used_ = -HUGE_VAL;
  int rays_ = 0;
};

/// A neighbour of the ray: one number moved by up to 2^20 units in the last place.
Ray moved(Ray ray, SplitMix64& rng) {
  const int which = static_cast<int>(rng.next_below(6));
  float& number = which < 3 ? ray.origin[which] : ray.direction[which - 3];
  const double ulp = std::nextafter(std::abs(number), HUGE_VALF) - std::abs(number);
  const double steps = std::ldexp(1, static_cast<int>(rng.next_below(21)));
  number = static_cast<float>(number + (rng.next_below(2) == 0 ? steps : -steps) * ulp);
  return ray;
}

/// Moves to smaller and smaller values of the objective. Checks each ray that it visits.
void climb(Arena& arena, Ray ray, int steps, std::uint64_t seed, const std::function<double(const Ray&)>& objective) {
  SplitMix64 rng(seed);
  double best = objective(ray);
  for (int i = 0; i < steps && !testing::Test::HasFatalFailure(); ++i) {
    const Ray next = moved(ray, rng);
    if (!is_valid(next)) continue;
    const double value = objective(next);
    if (!(value <= best)) continue;
    best = value;
    ray = next;
    arena.check(ray);
  }
}

std::vector<test::World> arenas() {
  std::vector<test::World> worlds{test::touching_world(5), test::nested_world(61, 20),
                                  test::coincident_world(62, 20, 5)};
  worlds.push_back(test::random_world("far and small", 63, 100, 20, 0.001, 0.001));
  worlds.back().view_distance = 100;
  worlds.push_back(test::random_world("overlapping", 64, 100, 5, 0.5, 2));
  worlds.push_back(test::random_world("mixed radii", 65, 100, 1, 1e-5, 1));
  worlds.push_back(test::random_world("far from 0", 66, 100, 12, 1, 1, 1e5, -1e5, 1e5));
  worlds.push_back(test::random_world("very far eye", 67, 100, 1, 0.1, 0.5));
  worlds.back().view_distance = 1e5;
  worlds.push_back(test::random_world("an eye beyond all reason", 69, 100, 1, 0.1, 0.5));
  worlds.back().view_distance = 1e12;
  return worlds;
}

/// From many starts in every arena; the objective may depend on the arena and on a number.
void climb_everywhere(
    const std::function<std::function<double(const Ray&)>(const Arena&, const Ray&, SplitMix64&)>& goal) {
  const char* const number = std::getenv("BIHIVE_LONG");
  const std::uint64_t long_runs = number == nullptr ? 1 : std::strtoull(number, nullptr, 10);
  const auto share = static_cast<std::uint64_t>(std::max<std::int64_t>(1, test::test_share() / 16));
  const std::uint64_t starts = 40 * long_runs / share;
  for (const test::World& world : arenas()) {
    SCOPED_TRACE(world.name);
    Arena arena(world);
    const test::RayMaker rays(arena.world(), 68);
    for (std::uint64_t start = 0; start < starts && !testing::Test::HasFatalFailure(); ++start) {
      SplitMix64 rng(start);
      const Ray ray = rays(start);
      climb(arena, ray, 400, start, goal(arena, ray, rng));
    }
    if (!testing::Test::HasFatalFailure()) arena.check_wide();
    testing::Test::RecordProperty("most padding used, " + world.name, std::to_string(arena.most_padding_used()));
    EXPECT_GT(arena.rays(), 400) << "the search hardly moved";
    EXPECT_LT(arena.most_padding_used(), 0.6) << "the padding is derived with a margin";
  }
}

TEST(Adversarial, Silhouettes) {
  climb_everywhere([](const Arena& arena, const Ray&, SplitMix64& rng) {
    const std::int64_t id = static_cast<std::int64_t>(rng.next_below(arena.world().size()));
    return [&arena, id](const Ray& ray) {
      // The distance between line and surface, by the library's own sum. Its sign breaks ties of the float grid.
      const ScaledRay scaled(ray, arena.spheres());
      const Vec3d oc = arena.spheres().stored_centre(id) - scaled.origin;
      const Vec3d p = oc - dot(oc, scaled.direction) / scaled.direction_squared * scaled.direction;
      const double r = arena.spheres().stored_radius(id);
      return std::abs(r * r - dot(p, p)) / (r * r);
    };
  });
}

TEST(Adversarial, EqualT) {
  climb_everywhere([](const Arena& arena, const Ray&, SplitMix64& rng) {
    const std::int64_t a = static_cast<std::int64_t>(rng.next_below(arena.world().size()));
    // The nearest other sphere, by the distance of the surfaces.
    std::int64_t b = -1;
    double nearest = HUGE_VAL;
    for (std::int64_t id = 0; id < arena.spheres().size(); ++id) {
      if (id == a) continue;
      const Vec3d apart = arena.spheres().stored_centre(id) - arena.spheres().stored_centre(a);
      const double gap = std::abs(length(apart) - arena.spheres().stored_radius(id) - arena.spheres().stored_radius(a));
      if (gap < nearest) nearest = gap, b = id;
    }
    return [&arena, a, b](const Ray& ray) {
      const ScaledRay scaled(ray, arena.spheres());
      double t[2];
      for (const int k : {0, 1}) {
        const std::int64_t id = k == 0 ? a : b;
        const Vec3d oc = arena.spheres().stored_centre(id) - scaled.origin;
        const double t_closest = dot(oc, scaled.direction) / scaled.direction_squared;
        const Vec3d p = oc - t_closest * scaled.direction;
        const double r = arena.spheres().stored_radius(id);
        // Beside the sphere the objective leads back to the sphere.
        const double inside = (r * r - dot(p, p)) / scaled.direction_squared;
        t[k] = t_closest - (inside >= 0 ? std::sqrt(inside) : -std::sqrt(-inside));
      }
      return std::abs(t[0] - t[1]);
    };
  });
}

TEST(Adversarial, HitsOutsideTheirBoxes) {
  climb_everywhere([](const Arena& arena, const Ray&, SplitMix64&) {
    return [&arena](const Ray& ray) {
      const Hit hit = closest_hit(arena.spheres(), ray);
      return hit.found() ? -arena.padding_used(ray, hit) : 1e300;
    };
  });
}

}  // namespace
}  // namespace bihive
