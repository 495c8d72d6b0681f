// Sets far from 0: their origin, and pictures, rays and points about it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bihive/geometry/rounding_loss.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/scene_file.h"
#include "bihive/wide/point_queries.h"

namespace bihive {
namespace {

struct Columns {
  std::vector<double> x, y, z, r;

  SphereSet set(SphereSet::Origin origin = SphereSet::Origin::fitting) const {
    return SphereSet::from_world(NumbersView::of(x), NumbersView::of(y), NumbersView::of(z), NumbersView::of(r), origin)
        .value();
  }
  Columns minus(Vec3d by) const {
    Columns moved = *this;
    for (double& value : moved.x) value -= by.x;
    for (double& value : moved.y) value -= by.y;
    for (double& value : moved.z) value -= by.z;
    return moved;
  }
};

// Coordinates with six digits after the point, as a file has them.
Columns helix(Vec3d at) {
  Columns helix;
  for (int k = 0; k < 300; ++k) {
    helix.x.push_back(std::round(1e6 * (std::cos(0.2 * k) + at.x)) / 1e6);
    helix.y.push_back(std::round(1e6 * (std::sin(0.2 * k) + at.y)) / 1e6);
    helix.z.push_back(std::round(1e6 * (0.02 * k + at.z)) / 1e6);
    helix.r.push_back(0.1);
  }
  return helix;
}

const Vec3d kUtm{500000, 5400000, 100};

void expect_same_stored(const SphereSet& a, const SphereSet& b) {
  EXPECT_EQ(a.scale_exponent(), b.scale_exponent());
  EXPECT_EQ(a.x(), b.x());
  EXPECT_EQ(a.y(), b.y());
  EXPECT_EQ(a.z(), b.z());
  EXPECT_EQ(a.r(), b.r());
}

TEST(Origin, IsZeroWhereRoundingAboutZeroIsHarmless) {
  EXPECT_FALSE(helix({}).set().has_origin());
  EXPECT_FALSE(helix({1000, -1000, 1000}).set().has_origin());
  // Nothing is finer about another origin.
  Columns wide{{-1e6, 1e6, 0}, {0, 0, 0}, {0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  wide.x.push_back(0.3);
  wide.y.push_back(0.7);
  wide.z.push_back(1e5);
  wide.r.push_back(1e-4);
  EXPECT_FALSE(wide.set().has_origin());
  // Points of radius 0 cannot move by a share of it.
  Columns points = helix(kUtm);
  points.r.assign(points.r.size(), 0);
  EXPECT_FALSE(points.set().has_origin());
  EXPECT_FALSE(helix(kUtm).set(SphereSet::Origin::zero).has_origin());
  EXPECT_FALSE(built_in_scene("demo", {}, {}).value().scene.spheres.has_origin());
}

// Numbers that binary32 holds exactly, of spheres that are small beside their distance from 0.
TEST(Origin, FitsSetsThatAreFarAwayForTheirSize) {
  const auto grid = [](double at, double radius) {
    Columns made;
    for (int k = 0; k < 64; ++k) {
      made.x.push_back(at + k % 4);
      made.y.push_back(k / 4 % 4);
      made.z.push_back(k / 16);
      made.r.push_back(radius);
    }
    return made;
  };
  EXPECT_TRUE(grid(0x1p17, 0.25).set().has_origin());
  EXPECT_FALSE(grid(0x1p17, 0.25).set(SphereSet::Origin::zero).has_origin());
  EXPECT_FALSE(grid(0x1p11, 0.25).set().has_origin()) << "a radius of 2^-14 stored units";
  EXPECT_FALSE(grid(0, 0x1p-20).set().has_origin()) << "small spheres around 0";
  Columns wide = grid(0x1p17, 0.25);
  wide.x.push_back(0);
  wide.y.push_back(0);
  wide.z.push_back(0);
  wide.r.push_back(0.25);
  EXPECT_FALSE(wide.set().has_origin()) << "of which 0 is a part";
}

TEST(Origin, HasFewBitsSoThatTheDifferenceIsExact) {
  for (const Vec3d at : {kUtm, Vec3d{1e9, -1e9, 3e9}, Vec3d{0, 0, 1e8}, Vec3d{1e5, 0, 0}}) {
    const Columns world = helix(at);
    const SphereSet set = world.set();
    ASSERT_TRUE(set.has_origin());
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(set.origin()[axis], std::nearbyint(set.origin()[axis]));
    expect_same_stored(set, world.minus(set.origin()).set(SphereSet::Origin::zero));
    // Half a unit in the last place of the set's own extent, along each axis.
    const double ulp = std::ldexp(set.inverse_scale(), -24);
    for (std::int64_t id = 0; id < set.size(); ++id) {
      const auto i = static_cast<std::size_t>(id);
      const Vec3d moved = set.local_centre(id) - set.to_local({world.x[i], world.y[i], world.z[i]});
      for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(moved[axis]), 0.5 * ulp);
      EXPECT_EQ(set.to_local(set.centre(id)), set.local_centre(id));
    }
    EXPECT_EQ(rounding_loss(set, NumbersView::of(world.x), NumbersView::of(world.y), NumbersView::of(world.z),
                            NumbersView::of(world.r))
                  .moved,
              0);
  }
}

TEST(Origin, BoundsAndPartsSpeakOfTheWorld) {
  const SphereSet set = helix(kUtm).set();
  const SphereSet::Bounds bounds = set.bounds();
  EXPECT_NEAR(bounds.lo.x, 499998.9, 1e-4);
  EXPECT_NEAR(bounds.hi.y, 5400001.1, 1e-3);
  const SphereSet part = set.part({7, 3});
  EXPECT_EQ(part.origin(), set.origin());
  EXPECT_EQ(part.centre(0), set.centre(7));
  SphereSet copies = set;
  ASSERT_TRUE(copies.replicate({Vec3d{4, 0, 0}, Vec3d{0, 4, 0}, Vec3d{0, 0, 8}}, {2, 1, 1}));
  EXPECT_EQ(copies.origin(), set.origin());
  EXPECT_NEAR(copies.centre(set.size() + 5).x, set.centre(5).x + 4, 1e-6);
}

TEST(Origin, AWarningNamesTheCentresThatMoveInASetTooWideForItsRadii) {
  const Columns wide{{1e6 + 0.03, 2e6, 0}, {0, 0, 0}, {0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  const SphereSet set = wide.set();
  const RoundingLoss loss = rounding_loss(set, NumbersView::of(wide.x), NumbersView::of(wide.y),
                                          NumbersView::of(wide.z), NumbersView::of(wide.r));
  EXPECT_EQ(loss.moved, 1);
  EXPECT_EQ(loss.worst_id, 0);
  EXPECT_NE(rounding_warning(loss, 3).find("moves 1 of 3 centres by more than 1 % of the radius (sphere 0"),
            std::string::npos);
}

// Rays are relative to the origin; points are of the world.
TEST(Origin, RaysAndPointsMeetTheSpheres) {
  const Columns world = helix(kUtm);
  const SphereSet far = world.set();
  const SphereSet near = world.minus(far.origin()).set(SphereSet::Origin::zero);
  for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute}) {
    const Tracer of_far = Tracer::build(far, engine).value(), of_near = Tracer::build(near, engine).value();
    for (int k = 0; k < 300; ++k) {
      Ray ray;
      ray.origin = to_float(far.to_local(kUtm + Vec3d{5, 0.01 * k, 3}));
      ray.direction = {-1, 0.001F * static_cast<float>(k), 0};
      EXPECT_EQ(of_far.closest_hit(ray).t, of_near.closest_hit(ray).t);
      EXPECT_EQ(of_far.closest_hit(ray).sphere_id, of_near.closest_hit(ray).sphere_id);
    }
  }
  const Tracer tracer = Tracer::build(far, Engine::wide).value();
  const std::vector<double> points{world.x[17], world.y[17], world.z[17], 500000, 5400000, 103};
  const NearestSpheres found =
      nearest_spheres(*tracer.wide_tree(), PointSpan::rows(points.data(), 2), 1, 10, {DistanceTo::centre}).value();
  EXPECT_EQ(found.sphere_id[0], 17);
  EXPECT_LT(found.distance[0], 1e-6);
  EXPECT_NEAR(found.distance[1], 1, 1e-5);
}

// All frames of a file have the first one's origin, also the frame that is read alone.
TEST(Origin, IsOneForAllFrames) {
  const auto frame = [](double y) { return fmt::format("2\n\nC 500000.125 {} 0\nC 500001.5 {} 3\n", y, y + 1.25); };
  const std::string text = frame(5400000) + frame(5400002.5) + frame(1e8);
  const Vec3d first = read_spheres_from_memory(text, "a.xyz", {}).value().spheres.origin();
  ASSERT_NE(first, (Vec3d{}));
  ReadOptions options;
  options.frame = 1;
  const SphereFile second = read_spheres_from_memory(text, "a.xyz", options).value();
  EXPECT_EQ(second.spheres.origin(), first);
  EXPECT_NEAR(second.spheres.centre(1).y, 5400003.75, 1e-6);
  // Its own, where the spheres have gone far away.
  options.frame = 2;
  const SphereFile third = read_spheres_from_memory(text, "a.xyz", options).value();
  EXPECT_NE(third.spheres.origin(), first);
  EXPECT_NEAR(third.spheres.centre(1).y, 1e8 + 1.25, 1e-6);
}

std::string document(const Columns& spheres, Vec3d at) {
  const auto vector = [&at](double x, double y, double z) {
    const Vec3d sum = Vec3d{x, y, z} + at;
    return "[" + fmt::format("{}", sum.x) + ", " + fmt::format("{}", sum.y) + ", " + fmt::format("{}", sum.z) + "]";
  };
  std::string text =
      R"({"bihive_scene": 2, "camera": {"eye": )" + vector(7, 5, 9) + R"(, "look_at": )" + vector(0, 0, 3) +
      R"(, "up": [0, 0, 1], "fov_deg": 40}, "lights": [{"position": )" + vector(10, -3, 20) + R"(}, {"position": )" +
      vector(-4, 12, 5) + R"(, "radius": 1}], "plane": )" + R"({"point": )" + vector(0, 0, -1) +
      R"(, "normal": [0, 0, 1]}, "clips": [{"sphere": {"centre": )" + vector(1, 0, 1) +
      R"(, "radius": 1}}, {"plane": {"normal": [0, 0, 1], "offset": )" + fmt::format("{}", 2 + at.z) +
      R"(}}], "cell": {"vectors": [[3, 0, 0], [0, 3, 0], [0, 0, 7]], "origin": )" + vector(-1.5, -1.5, 0) +
      R"(}, "picture": {"cell_lines": {"width_px": 2, "colour": [1, 0, 0]}},)" + R"( "spheres": [)";
  for (std::size_t i = 0; i < spheres.x.size(); ++i)
    text += fmt::format(R"({}{{"centre": [{}, {}, {}], "radius": {}, "clips": [{}]}})", i > 0 ? ", " : "", spheres.x[i],
                        spheres.y[i], spheres.z[i], spheres.r[i], i < 200 ? "0" : "0, 1");
  return text + "]}";
}

Film picture_of(const Scene& scene) {
  RenderSettings settings;
  settings.width_px = 90;
  settings.height_px = 70;
  settings.shadows = true;
  settings.light_points = 4;
  settings.fog.emplace();
  settings.outline.emplace();
  settings.cell_lines = scene.picture.cell_lines;
  settings.ambient_occlusion.emplace();
  const Tracer tracer = Tracer::build(scene, Engine::wide).value();
  return render(scene, tracer, settings).value().film;
}

// Camera, lights, plane, clips and the cell of a scene file are of the world.
TEST(Origin, APictureHasTheBitsOfTheSameNumbersMinusTheOrigin) {
  const Columns world = helix(kUtm);
  const Scene far = parse_scene(document(world, kUtm), "far.json", {}).value().scene;
  ASSERT_TRUE(far.spheres.has_origin());
  const Vec3d origin = far.spheres.origin();
  const Scene near = parse_scene(document(world.minus(origin), kUtm - origin), "near.json", {}).value().scene;
  ASSERT_FALSE(near.spheres.has_origin());
  const Film of_far = picture_of(far), of_near = picture_of(near);
  EXPECT_EQ(of_far.radiance, of_near.radiance);

  // A written scene file reads as the same scene.
  const Scene again = parse_scene(scene_to_json(far), "again.json", {}).value().scene;
  EXPECT_EQ(again.spheres.origin(), origin);
  expect_same_stored(again.spheres, far.spheres);
  EXPECT_EQ(picture_of(again).radiance, of_far.radiance);
}

}  // namespace
}  // namespace bihive
