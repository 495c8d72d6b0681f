// Cut spheres: every engine gives the same bits, and the bits agree with constructive solid geometry in long double.
#include "bihive/scene/clips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/renderer.h"
#include "bihive/render/surface.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "support/clips.h"
#include "support/effort.h"
#include "support/scenes.h"
#include "support/stick_oracle.h"

namespace bihive {
namespace {

using Real = long double;
constexpr Real kNoHit = std::numeric_limits<Real>::infinity();

struct Point {
  Real x, y, z;
};
Point at(const Ray& ray, Real t) {
  return {ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y, ray.origin.z + t * ray.direction.z};
}

// Is the point taken away, and where does the ray cross the clip's border?
bool taken(const Clip& clip, Point p) {
  if (const auto* plane = std::get_if<PlaneClip>(&clip))
    return plane->normal.x * p.x + plane->normal.y * p.y + plane->normal.z * p.z > plane->offset;
  if (const auto* box = std::get_if<BoxClip>(&clip))
    return p.x > box->lo.x && p.x < box->hi.x && p.y > box->lo.y && p.y < box->hi.y && p.z > box->lo.z &&
           p.z < box->hi.z;
  const auto& ball = std::get<SphereClip>(clip);
  const Real x = p.x - ball.centre.x, y = p.y - ball.centre.y, z = p.z - ball.centre.z;
  return x * x + y * y + z * z < Real(ball.radius) * ball.radius;
}

void add_roots(const Ray& ray, Vec3d centre, Real radius, std::vector<Real>& roots) {
  const Real dx = ray.direction.x, dy = ray.direction.y, dz = ray.direction.z;
  const Real ox = centre.x - Real(ray.origin.x), oy = centre.y - Real(ray.origin.y), oz = centre.z - Real(ray.origin.z);
  const Real dd = dx * dx + dy * dy + dz * dz;
  const Real cx = oy * dz - oz * dy, cy = oz * dx - ox * dz, cz = ox * dy - oy * dx;
  const Real discriminant = radius * radius - (cx * cx + cy * cy + cz * cz) / dd;
  if (!(discriminant >= 0) || !(radius > 0)) return;
  const Real middle = (ox * dx + oy * dy + oz * dz) / dd, half = std::sqrt(discriminant / dd);
  roots.push_back(middle - half);
  roots.push_back(middle + half);
}

void add_borders(const Ray& ray, const Clip& clip, std::vector<Real>& roots) {
  if (const auto* plane = std::get_if<PlaneClip>(&clip)) {
    const Vec3d n = plane->normal;
    const Real speed = n.x * Real(ray.direction.x) + n.y * Real(ray.direction.y) + n.z * Real(ray.direction.z);
    const Real height = n.x * Real(ray.origin.x) + n.y * Real(ray.origin.y) + n.z * Real(ray.origin.z);
    if (speed != 0) roots.push_back((plane->offset - height) / speed);
  } else if (const auto* box = std::get_if<BoxClip>(&clip)) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double wall : {box->lo[axis], box->hi[axis]})
        if (ray.direction[axis] != 0) roots.push_back((wall - Real(ray.origin[axis])) / ray.direction[axis]);
  } else {
    const auto& ball = std::get<SphereClip>(clip);
    add_roots(ray, ball.centre, ball.radius, roots);
  }
}

// The first place of the line, from t = 0 on, where the solid begins or ends, and the length of the part of the solid
// there.
struct Expected {
  Real t = kNoHit;
  Real thickness = kNoHit;
};

// `ends`: where the line goes through the whole body, or nothing; `bits`: of the clips that cut it.
Expected expected_of(const Scene& scene, const Ray& ray, std::vector<Real> ends, std::uint64_t bits) {
  if (ends.empty()) return {};
  const Real near = ends[0], far = ends[1];
  for (std::size_t k = 0; k < scene.clips.size(); ++k)
    if ((bits >> k & 1) != 0) add_borders(ray, scene.clips[k], ends);
  std::sort(ends.begin(), ends.end());
  const auto is_solid = [&](Real t) {
    if (!(t > near && t < far)) return false;
    for (std::size_t k = 0; k < scene.clips.size(); ++k)
      if ((bits >> k & 1) != 0 && taken(scene.clips[k], at(ray, t))) return false;
    return true;
  };
  bool before = false;
  Real begin = -kNoHit;
  Expected found;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool after = i + 1 < ends.size() && is_solid((ends[i] + ends[i + 1]) / 2);
    if (after != before) {
      if (found.t < kNoHit) {
        found.thickness = std::min(found.thickness, ends[i] - found.t);
        return found;
      }
      if (after) begin = ends[i];
      if (ends[i] >= 0) {
        found.t = ends[i];
        if (!after) return {ends[i], ends[i] - begin};
      }
    }
    before = after;
  }
  return found;
}

Expected expected_hit(const Scene& scene, const Ray& ray, std::int64_t id) {
  std::vector<Real> ends;
  add_roots(ray, scene.spheres.centre(id), scene.spheres.radius(id), ends);
  return expected_of(scene, ray, ends, scene.spheres.attributes().clips[static_cast<std::size_t>(id)]);
}

Ray random_ray(SplitMix64& rng, double size, Vec3d middle) {
  const auto coordinate = [&](double m) { return static_cast<float>(m + size * (2 * rng.next_double() - 1)); };
  Ray ray;
  ray.origin = {coordinate(middle.x), coordinate(middle.y), coordinate(middle.z)};
  ray.direction = Vec3f{coordinate(middle.x), coordinate(middle.y), coordinate(middle.z)} - ray.origin;
  return ray;
}

// Each ray against each sphere. The two may differ by more than rounding only where the ray grazes the solid.
void expect_oracle(const Scene& scene, double size, std::uint64_t seed, const std::string& what, std::int64_t& hits) {
  const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  ASSERT_NE(cuts, nullptr) << what;
  SplitMix64 rng(seed);
  std::int64_t grazed = 0;
  const std::int64_t rays = 3000 / test::ray_share();
  for (std::int64_t i = 0; i < rays; ++i) {
    const auto id = static_cast<std::int64_t>(rng.next() % static_cast<std::uint64_t>(scene.spheres.size()));
    // Aimed at the sphere, or a little beside it.
    Ray ray = random_ray(rng, 1.5 * size, {});
    const double reach = 1.1 * scene.spheres.radius(id);
    const auto beside = [&] { return reach * (2 * rng.next_double() - 1); };
    ray.direction = to_float(scene.spheres.centre(id) + Vec3d{beside(), beside(), beside()} - to_double(ray.origin));
    if (!is_valid(ray) || cuts->remainder(id) != Remainder::cut) continue;
    const Expected expected = expected_hit(scene, ray, id);
    const double t = cuts->hit(cuts->entering(ray, cuts->cutting(id)), id).t;
    const Real tolerance = 1e-9L;
    const bool same = expected.t == kNoHit ? t == std::numeric_limits<double>::infinity()
                                           : std::abs(t - expected.t) <= tolerance * std::max<Real>(1, expected.t);
    if (expected.t < kNoHit) ++hits;
    if (same) continue;
    ++grazed;
    // What grazes: the solid is thin on one of both ways.
    ASSERT_TRUE(expected.thickness < 1e-6L || expected.t == kNoHit || expected.t < 1e-9L)
        << what << ", ray " << i << ", sphere " << id << ": " << t << ", expected " << static_cast<double>(expected.t);
  }
  EXPECT_LE(grazed, rays / 500) << what;
}

Scene scene_of(const test::World& world) {
  Scene scene;
  scene.spheres = test::sphere_set(world);
  return scene;
}

void clip_all(Scene& scene, const std::vector<Clip>& clips) {
  scene.clips = clips;
  scene.spheres.attributes().clips.assign(static_cast<std::size_t>(scene.spheres.size()),
                                          (std::uint64_t{1} << clips.size()) - 1);
}

TEST(Clips, RandomSetsAgreeWithLongDouble) {
  std::int64_t hits = 0;
  for (std::uint64_t seed = 1; seed <= 60; seed += static_cast<std::uint64_t>(test::ray_share())) {
    Scene scene = scene_of(test::random_world("random", seed, 40, 10, 0.5, 5));
    test::add_random_clips(seed, 10, scene);
    if (cut_set_of(scene) != nullptr) expect_oracle(scene, 10, seed, "seed " + std::to_string(seed), hits);
  }
  // That rays hit anything. The floor is low because a sanitizer takes four sets alone, which have 61 hits.
  EXPECT_GT(hits, 500 / test::ray_share());
}

// Planes that touch, planes through centres, nested and coincident clips and spheres, spheres of radius 0.
std::vector<Scene> hostile_scenes() {
  std::vector<Scene> scenes;
  const std::vector<Clip> planes{PlaneClip{{0, 0, 1}, 0}, PlaneClip{{0, 3, 0}, 3}, PlaneClip{{-1, 0, 0}, 2}};
  scenes.push_back(scene_of(test::touching_world(4)));
  clip_all(scenes.back(), planes);
  scenes.push_back(scene_of(test::coincident_world(5, 20, 4)));
  clip_all(scenes.back(), {PlaneClip{{1, 1, 1}, 0}, PlaneClip{{2, 2, 2}, 0}, BoxClip{{-1, -1, -1}, {1, 1, 1}}});
  scenes.push_back(scene_of(test::nested_world(6, 10)));
  clip_all(scenes.back(), {SphereClip{{0, 0, 0}, 4}, SphereClip{{0, 0, 0}, 2}, BoxClip{{0, 0, 0}, {9, 9, 9}}});
  scenes.push_back(scene_of(test::random_world("points", 7, 50, 3, 0, 0)));
  test::World mixed = test::random_world("mixed", 8, 50, 3, 1e-4, 3);
  mixed.add(0, 0, 0, 0);
  mixed.add(0, 0, 0, 1);
  scenes.push_back(scene_of(mixed));
  clip_all(scenes.back(), {SphereClip{{0, 0, 0}, 1}, PlaneClip{{0, 0, -1}, 0.5}});
  for (const double unit : {1e-20, 1e20}) {
    scenes.push_back(scene_of(test::random_world("units", 9, 60, 3, 0.1, 2).scaled(unit, "units")));
    clip_all(scenes.back(), {PlaneClip{{1, 2, 3}, 0.5 * unit}, BoxClip{{-unit, -unit, -unit}, {unit, unit, unit}},
                             SphereClip{{2 * unit, 0, 0}, unit}});
  }
  return scenes;
}

double size_of(const Scene& scene) {
  const SphereSet::Bounds box = scene.spheres.bounds();
  return std::max({std::abs(box.lo.x), std::abs(box.hi.x), std::abs(box.lo.y), std::abs(box.hi.y), std::abs(box.lo.z),
                   std::abs(box.hi.z)});
}

TEST(Clips, HostileSetsAgreeWithLongDouble) {
  std::uint64_t seed = 100;
  std::int64_t hits = 0;
  for (const Scene& scene : hostile_scenes()) {
    ++seed;
    if (cut_set_of(scene) != nullptr) expect_oracle(scene, size_of(scene), seed, "set " + std::to_string(seed), hits);
  }
  EXPECT_GT(hits, 500 / test::ray_share());
}

// Rays through the set; half of them leave what another ray hit, as shading does.
RayBatch rays_of(const Scene& scene, const Tracer& tracer, std::uint64_t seed) {
  SplitMix64 rng(seed);
  const double size = 1.5 * size_of(scene);
  RayBatch rays;
  for (std::int64_t i = 0; i < 4000 / test::ray_share(); ++i) {
    Ray ray = random_ray(rng, size, {});
    if (i % 5 == 0) ray.t_max = rng.next_double();
    if (i % 11 == 0) ray.t_min = 0.25 * rng.next_double();
    rays.push_back(ray);
    const SceneHit hit = scene_hit(scene, tracer, ray);
    if (!hit.found()) continue;
    const Surface surface = surface_at(scene, ray, hit);
    Ray next = random_ray(rng, size, {});
    next.origin = surface.origin;
    next.leaves = surface.id;
    const bool outward = dot(to_double(next.direction), surface.normal) > 0;
    next.inside = outward == surface.from_inside;
    rays.push_back(next);
  }
  return rays;
}

void expect_same_answers(const Scene& scene, std::uint64_t seed) {
  const Tracer brute = Tracer::build(scene, Engine::brute).value();
  const RayBatch batch = rays_of(scene, brute, seed);
  const RaySpan rays = batch.span();
  for (const Engine engine : {Engine::wide, Engine::reference}) {
    const Tracer tracer = Tracer::build(scene, engine).value();
    for (const RayOrder order : {RayOrder::any, RayOrder::blocks}) {
      HitBatch hits;
      hits.resize(rays.count);
      std::vector<std::uint8_t> hidden(static_cast<std::size_t>(rays.count), 2);
      tracer.closest_hits(rays, order, hits.span());
      tracer.occluded(rays, order, hidden.data());
      for (std::int64_t i = 0; i < rays.count; ++i) {
        const Hit expected = brute.closest_hit(rays.at(i));
        ASSERT_EQ(hits.at(i).t, expected.t) << seed << ", ray " << i;
        ASSERT_EQ(hits.at(i).sphere_id, expected.sphere_id) << seed << ", ray " << i;
        ASSERT_EQ(hidden[static_cast<std::size_t>(i)], expected.found() ? 1 : 0) << seed << ", ray " << i;
        if (order == RayOrder::blocks) continue;
        ASSERT_EQ(tracer.closest_hit(rays.at(i)).sphere_id, expected.sphere_id) << seed << ", ray " << i;
        ASSERT_EQ(tracer.occluded(rays.at(i)), expected.found()) << seed << ", ray " << i;
      }
    }
  }
}

TEST(Clips, EveryEngineGivesTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 24; seed += static_cast<std::uint64_t>(test::ray_share())) {
    Scene scene = scene_of(test::random_world("random", seed, 60, 10, 0.3, 6));
    test::add_random_clips(seed, 10, scene);
    expect_same_answers(scene, seed);
  }
  std::uint64_t seed = 200;
  for (const Scene& scene : hostile_scenes()) expect_same_answers(scene, ++seed);
}

// More groups of clips than the tracer keeps apart.
TEST(Clips, ManyGroupsGiveTheSameBits) {
  Scene scene = scene_of(test::random_world("random", 3, 120, 10, 0.3, 6));
  SplitMix64 rng(9);
  for (int k = 0; k < 7; ++k) scene.clips.push_back(test::random_clip(rng, 10));
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id)
    scene.spheres.attributes().clips.push_back(rng.next() % 128);
  expect_same_answers(scene, 300);
}

TEST(Clips, CrossingsOfTransparentSpheresAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Scene scene = scene_of(test::random_world("random", seed, 60, 10, 0.3, 6));
    test::add_random_clips(seed, 10, scene);
    scene.spheres.attributes().opacity.assign(60, 1);
    for (std::size_t i = 0; i < 60; i += 2) scene.spheres.attributes().opacity[i] = 0.5f;
    const RayBatch batch = rays_of(scene, Tracer::build(scene, Engine::brute).value(), seed);
    const auto brute = Transparency::of(scene, OpacityRule::once, Engine::brute, 1).value().to_light;
    const auto wide = Transparency::of(scene, OpacityRule::once, Engine::wide, 1).value().to_light;
    std::vector<RayHit> expected, found;
    brute->find_crossings(batch.span(), RayOrder::any, expected);
    wide->find_crossings(batch.span(), RayOrder::any, found);
    ASSERT_EQ(found.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].ray, expected[i].ray) << seed;
      ASSERT_EQ(found[i].t, expected[i].t) << seed;
      ASSERT_EQ(found[i].sphere_id, expected[i].sphere_id) << seed;
    }
    for (std::int64_t i = 0; i < batch.size(); i += 10)
      ASSERT_EQ(wide->share(batch.span().at(i)), brute->share(batch.span().at(i))) << seed;
  }
}

// One plane cuts all spheres: what leaves a cap on the side that is taken away meets nothing, whatever the units.
TEST(Clips, NoCapShadowsAnother) {
  for (const double unit : {1e-20, 1.0, 1e20}) {
    Scene scene = scene_of(test::random_world("base", 4, 80, 3, 0.2, 2).scaled(unit, "scaled"));
    const Vec3d normal{0.3, -0.2, 0.9};
    clip_all(scene, {PlaneClip{normal, 0.1 * unit}});
    const Tracer tracer = Tracer::build(scene, Engine::wide).value();
    SplitMix64 rng(5);
    int caps = 0;
    for (int i = 0; i < 3000; ++i) {
      const Ray ray = random_ray(rng, 4 * unit, {});
      const SceneHit hit = scene_hit(scene, tracer, ray);
      if (!hit.found()) continue;
      const Surface surface = surface_at(scene, ray, hit);
      if (surface.from_inside || dot(surface.normal, normalized(normal)) < 1 - 1e-12) continue;
      ++caps;
      Ray next = random_ray(rng, unit, {});
      if (dot(to_double(next.direction), normal) < 0) next.direction = -next.direction;
      next.origin = surface.origin;
      next.leaves = surface.id;
      EXPECT_FALSE(tracer.occluded(next)) << unit << ", ray " << i;
    }
    EXPECT_GT(caps, 100) << unit;
  }
}

// Bonds between random spheres.
void add_sticks(Scene& scene, double radius, SplitMix64& rng) {
  std::vector<SpherePair> pairs;
  const auto count = static_cast<std::uint64_t>(scene.spheres.size());
  for (int i = 0; i < 60; ++i)
    pairs.push_back(
        {static_cast<std::int32_t>(rng.next_below(count)), static_cast<std::int32_t>(rng.next_below(count))});
  scene.sticks = StickSet::between(scene.spheres, pairs, radius).value();
  // And round cones, some of which end in a point.
  std::vector<OwnStick> cones;
  for (int i = 0; i < 30; ++i) {
    const SpherePair& pair = pairs[static_cast<std::size_t>(i)];
    cones.push_back({scene.spheres.local_centre(pair[0]), scene.spheres.local_centre(pair[1]), 1.5 * radius,
                     i % 3 == 0 ? 0 : radius * rng.next_double(), pair[0]});
  }
  ASSERT_TRUE(scene.sticks.add(scene.spheres, cones).ok());
}

TEST(Clips, CutSticksAgreeWithConstructiveSolidGeometry) {
  std::int64_t hits = 0, on_caps = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SplitMix64 rng(400 + seed);
    Scene scene = scene_of(test::random_world("random", seed, 40, 10, 0.3, 3));
    test::add_random_clips(seed, 10, scene);
    add_sticks(scene, 0.4 + 0.2 * double(seed % 4), rng);
    const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
    ASSERT_NE(cuts, nullptr);
    const double scale = scene.spheres.inverse_scale();
    std::int64_t grazed = 0;
    const std::int64_t rays = 4000 / test::ray_share();
    for (std::int64_t i = 0; i < rays; ++i) {
      const auto stick = static_cast<std::int64_t>(rng.next_below(std::uint64_t(scene.sticks.size())));
      const Stick stored = scene.sticks.stored(scene.spheres, stick);
      const Vec3d aim = (stored.a + rng.next_double() * (stored.b - stored.a)) * scale;
      Ray ray = random_ray(rng, 15, {});
      const auto beside = [&] { return 0.8 * (2 * rng.next_double() - 1); };
      ray.direction = to_float(aim + Vec3d{beside(), beside(), beside()} - to_double(ray.origin));
      if (!is_valid(ray) || cuts->remainder_of_stick(stick) == Remainder::whole) continue;
      std::uint64_t bits = ~std::uint64_t{0};
      for (const std::int64_t half : {2 * stick, 2 * stick + 1})
        bits &= scene.spheres.attributes().clips[static_cast<std::size_t>(scene.sticks.sphere_at(scene.spheres, half))];
      const StickRay of = stick_ray(ray, scene.spheres, scene.sticks);
      const StickRoots roots = stick_roots(of.ray, stored);
      std::vector<Real> ends;
      if (roots.t_near <= roots.t_far) ends = {roots.t_near, roots.t_far};
      const Expected expected = expected_of(scene, ray, ends, bits);
      CutHit found;
      if (cuts->remainder_of_stick(stick) == Remainder::cut) {
        const CutRay entered = cuts->entering(ray, cuts->cutting_sticks());
        found = cuts->stick_hit(entered, cuts->stick_ray_of(ray, entered), stick).hit;
      }
      const bool same = expected.t == kNoHit ? found.t == std::numeric_limits<double>::infinity()
                                             : std::abs(found.t - expected.t) <= 1e-9L * std::max<Real>(1, expected.t);
      hits += expected.t < kNoHit ? 1 : 0;
      on_caps += found.clip >= 0 ? 1 : 0;
      if (same) continue;
      ++grazed;
      ASSERT_TRUE(expected.thickness < 1e-6L || expected.t == kNoHit || expected.t < 1e-9L)
          << seed << ", ray " << i << ", stick " << stick << ": " << found.t << ", expected "
          << static_cast<double>(expected.t);
    }
    EXPECT_LE(grazed, rays / 500) << seed;
  }
  EXPECT_GT(hits, 1000 / test::ray_share());
  EXPECT_GT(on_caps, 300 / test::ray_share());
}

// A body of a scene along a ray, in long double: the solid that clips leave of it.
struct SolidBody {
  std::int64_t id;
  std::vector<Real> ends;
  std::uint64_t bits;

  bool holds(const Scene& scene, const Ray& ray, Real t) const {
    if (!(t > ends[0] && t < ends[1])) return false;
    for (std::size_t k = 0; k < scene.clips.size(); ++k)
      if ((bits >> k & 1) != 0 && taken(scene.clips[k], at(ray, t))) return false;
    return true;
  }
};

// The bodies of one opacity that the line meets.
std::vector<SolidBody> bodies_of(const Scene& scene, const Ray& ray, float opacity) {
  const SphereAttributes& attributes = scene.spheres.attributes();
  const auto bits_of = [&](std::int64_t sphere) {
    return attributes.clips.empty() ? 0 : attributes.clips[static_cast<std::size_t>(sphere)];
  };
  std::vector<SolidBody> bodies;
  const auto add = [&](std::int64_t id, std::vector<Real> ends, std::uint64_t bits) {
    if (ends.size() == 2) bodies.push_back({id, std::move(ends), bits});
  };
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    if (attributes.opacity[static_cast<std::size_t>(id)] != opacity) continue;
    std::vector<Real> ends;
    add_roots(ray, scene.spheres.centre(id), scene.spheres.radius(id), ends);
    add(id, ends, bits_of(id));
  }
  for (std::int64_t stick = 0; stick < scene.sticks.size(); ++stick) {
    const std::int64_t one = scene.sticks.sphere_at(scene.spheres, 2 * stick);
    const std::int64_t other = scene.sticks.sphere_at(scene.spheres, 2 * stick + 1);
    if (attributes.opacity[static_cast<std::size_t>(one)] != opacity) continue;
    const test::StickOracle oracle(ScaledRay(ray, scene.spheres.scale()), scene.sticks.stored(scene.spheres, stick));
    if (oracle.roots().exist())
      add(scene.spheres.size() + 2 * stick, {oracle.roots().t_near, oracle.roots().t_far},
          bits_of(one) & bits_of(other));
  }
  return bodies;
}

// Where the line enters the union of the bodies from t = 0 on, or exits it if it starts inside: OpacityRule::as_one.
// Nothing where rounding may decide.
std::optional<std::vector<Real>> entries_of(const Scene& scene, const Ray& ray, const std::vector<SolidBody>& bodies) {
  std::vector<Real> borders{0};
  for (const SolidBody& body : bodies) {
    std::vector<Real> ends = body.ends;
    for (std::size_t k = 0; k < scene.clips.size(); ++k)
      if ((body.bits >> k & 1) != 0) add_borders(ray, scene.clips[k], ends);
    borders.insert(borders.end(), ends.begin(), ends.end());
  }
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  const auto is_solid = [&](Real t) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const SolidBody& body) { return body.holds(scene, ray, t); });
  };
  std::vector<Real> entries;
  bool before = false, counts_exit = false;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (borders[i] < 0) continue;
    if (i + 1 < borders.size() && borders[i + 1] - borders[i] < 1e-7L) return std::nullopt;
    const bool after = i + 1 < borders.size() && is_solid((borders[i] + borders[i + 1]) / 2);
    if (borders[i] == 0)
      counts_exit = after;
    else if (after && !before)
      entries.push_back(borders[i]);
    else if (before && !after && counts_exit) {
      entries.push_back(borders[i]);
      counts_exit = false;
    }
    before = after;
  }
  return entries;
}

TEST(Clips, OverlappingBodiesAreOneSolid) {
  std::int64_t several = 0, from_inside = 0, left_out = 0, asked = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SplitMix64 rng(600 + seed);
    Scene scene = scene_of(test::random_world("random", seed, 50, 6, 0.5, 2));
    if (seed % 2 == 0) test::add_random_clips(seed, 6, scene);
    for (int i = 0; i < 50; ++i) scene.spheres.attributes().opacity.push_back(i % 2 == 0 ? 0.25F : 0.5F);
    std::vector<SpherePair> pairs;
    for (std::int32_t i = 0; i + 2 < 50; ++i) pairs.push_back({i, i + 2});
    scene.sticks = StickSet::between(scene.spheres, pairs, 0.25).value();
    ASSERT_TRUE(scene.sticks.add(scene.spheres, {{{0, 0, 0}, {3, 1, 2}, 1, 0, 0}, {{0, 1, 0}, {-3, 1, 2}, 0.5, 1, 1}}));
    const auto divided = Transparency::of(scene, OpacityRule::as_one, Engine::wide, 1).value().to_eye;
    const auto brute = Transparency::of(scene, OpacityRule::as_one, Engine::brute, 1).value().to_eye;
    const std::int64_t rays = 2000 / test::ray_share();
    for (std::int64_t i = 0; i < rays; ++i) {
      const Ray ray = random_ray(rng, i % 2 == 0 ? 5 : 12, {});
      if (!is_valid(ray)) continue;
      std::vector<Crossing> found, by_brute;
      divided->find_crossings(ray, found);
      brute->find_crossings(ray, by_brute);
      ASSERT_EQ(found.size(), by_brute.size());
      double share = 1;
      for (const float opacity : {0.25F, 0.5F}) {
        const std::vector<SolidBody> bodies = bodies_of(scene, ray, opacity);
        const std::optional<std::vector<Real>> expected = entries_of(scene, ray, bodies);
        ++asked;
        std::size_t next = 0;
        for (const Crossing& crossing : found) {
          const std::int64_t sphere = shown_sphere(scene, crossing.id);
          if (scene.spheres.attributes().opacity[static_cast<std::size_t>(sphere)] != opacity) continue;
          if (opacity == 0.25F) share = share * (1 - double(opacity));
          if (expected) {
            ASSERT_LT(next, expected->size()) << seed << ", ray " << i;
            ASSERT_NEAR(crossing.t, double((*expected)[next]), 1e-9 * (1 + crossing.t)) << seed << ", ray " << i;
            // The body whose border it is, by its ends or by its clips.
            const std::int64_t half = crossing.id - scene.spheres.size();
            const std::int64_t id = half < 0 ? crossing.id : crossing.id - half % 2;
            const auto body =
                std::find_if(bodies.begin(), bodies.end(), [&](const SolidBody& b) { return b.id == id; });
            ASSERT_NE(body, bodies.end());
            const Real e = 1e-8L * (1 + crossing.t);
            ASSERT_NE(body->holds(scene, ray, crossing.t - e), body->holds(scene, ray, crossing.t + e));
          }
          ++next;
        }
        if (!expected) {
          ++left_out;
          continue;
        }
        ASSERT_EQ(next, expected->size()) << seed << ", ray " << i;
        several += expected->size() > 1 ? 1 : 0;
        from_inside += std::any_of(bodies.begin(), bodies.end(),
                                   [&](const SolidBody& body) { return body.holds(scene, ray, 1e-12L); })
                           ? 1
                           : 0;
      }
      for (const Crossing& crossing : found)
        if (shown_sphere(scene, crossing.id) % 2 == 1) share = share * 0.5;
      ASSERT_EQ(divided->share(ray), (Vec3d{share, share, share})) << seed << ", ray " << i;
      for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k].t, by_brute[k].t);
        ASSERT_EQ(found[k].id, by_brute[k].id);
      }
    }
  }
  EXPECT_GT(several, 500 / test::ray_share());
  EXPECT_GT(from_inside, 500 / test::ray_share());
  EXPECT_LT(left_out, asked / 20);
}

TEST(Clips, EveryEngineGivesTheSameBitsOfSticks) {
  for (std::uint64_t seed = 1; seed <= 4; seed += static_cast<std::uint64_t>(test::ray_share())) {
    SplitMix64 rng(500 + seed);
    Scene scene = scene_of(test::random_world("random", seed, 60, 10, 0.3, 6));
    test::add_random_clips(seed, 10, scene);
    add_sticks(scene, 0.3, rng);
    expect_same_answers(scene, seed);
  }
}

// The same for sticks of their spheres' radius: what leaves a cap, of a ball or of a stick, meets nothing.
TEST(Clips, NoCapShadowsAnotherOfSticks) {
  test::World world;
  SplitMix64 rng(6);
  for (int i = 0; i < 40; ++i)
    world.add(3 * (2 * rng.next_double() - 1), 3 * (2 * rng.next_double() - 1), 3 * (2 * rng.next_double() - 1), 0.25);
  Scene scene = scene_of(world);
  const Vec3d normal{0.3, -0.2, 0.9};
  clip_all(scene, {PlaneClip{normal, 0.1}});
  add_sticks(scene, 0.25, rng);
  for (const Engine engine : {Engine::wide, Engine::reference}) {
    const Tracer tracer = Tracer::build(scene, engine).value();
    int caps[2] = {0, 0};
    for (int i = 0; i < 12000; ++i) {
      const Ray ray = random_ray(rng, 4, {});
      const SceneHit hit = scene_hit(scene, tracer, ray);
      if (!hit.found()) continue;
      const Surface surface = surface_at(scene, ray, hit);
      if (surface.from_inside || dot(surface.normal, normalized(normal)) < 1 - 1e-12) continue;
      ++caps[hit.id >= scene.spheres.total_size() ? 1 : 0];
      Ray next = random_ray(rng, 1, {});
      if (dot(to_double(next.direction), normal) < 0) next.direction = -next.direction;
      next.origin = surface.origin;
      next.leaves = surface.id;
      EXPECT_FALSE(tracer.occluded(next)) << i;
    }
    EXPECT_GT(caps[0], 5);
    EXPECT_GT(caps[1], 100);
  }
}

TEST(Clips, ThreadsDoNotChangeAPicture) {
  Scene scene = scene_of(test::random_world("random", 2, 200, 10, 0.5, 3));
  test::add_random_clips(2, 10, scene);
  scene.camera.eye = {0, 0, 30};
  scene.lights.push_back({{20, 30, 40}});
  scene.materials[0].reflective = 0.3;
  RenderSettings settings;
  settings.width_px = 150;
  settings.height_px = 100;
  settings.ambient_occlusion.emplace();
  Film first;
  for (const int threads : {1, 2, 7}) {
    settings.threads = threads;
    const Tracer tracer = Tracer::build(scene, Engine::wide, {}, threads).value();
    Film film = render(scene, tracer, settings).value().film;
    if (threads == 1) first = film;
    ASSERT_EQ(film.radiance.size(), first.radiance.size());
    EXPECT_EQ(std::memcmp(film.radiance.data(), first.radiance.data(), film.radiance.size() * sizeof(Vec3f)), 0);
  }
}

TEST(Clips, ATracerWithoutTheClipsIsRefused) {
  Scene scene = scene_of(test::random_world("random", 2, 20, 10, 0.5, 3));
  clip_all(scene, {PlaneClip{{0, 0, 1}, 0}});
  EXPECT_FALSE(render(scene, Tracer::build(scene.spheres, Engine::wide).value(), RenderSettings()));
  EXPECT_TRUE(render(scene, Tracer::build(scene, Engine::wide).value(), [] {
    RenderSettings small;
    small.width_px = small.height_px = 4;
    return small;
  }()));
}

}  // namespace
}  // namespace bihive
