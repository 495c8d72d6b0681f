#include "bihive/scene/traces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "bihive/geometry/sphere_attributes.h"

namespace bihive {
namespace {

using ::testing::HasSubstr;

struct Place {
  double x, y, z;
  int mol;
};

Scene beads(const std::vector<Place>& places) {
  std::vector<double> x, y, z, r, mol;
  for (const Place& place : places) {
    x.push_back(place.x);
    y.push_back(place.y);
    z.push_back(place.z);
    r.push_back(1);
    mol.push_back(place.mol);
  }
  Scene scene;
  scene.spheres = SphereSet::from_world(x, y, z, r).value();
  scene.spheres.attributes().numbers = {{"mol", mol}, {"b", x}};
  return scene;
}

Traces by_mol() {
  Traces traces;
  traces.by = TraceBy::mol;
  return traces;
}

Stick tube_stick(const Scene& scene, std::int64_t k) {
  const Stick made = scene.sticks.stored(scene.spheres, k);
  const double world = scene.spheres.inverse_scale();
  return {world * made.a, world * made.b, world * made.radius_a, world * made.radius_b};
}

TEST(Traces, go_through_the_beads_of_each_molecule) {
  Scene scene = beads({{0, 0, 0, 1}, {9, 0, 0, 2}, {1, 1, 0, 1}, {2, 0, 0, 1}, {9, 1, 0, 2}, {3, 1, 0, 1}});
  const Result<AddedTraces> added = add_traces(scene, by_mol());
  ASSERT_TRUE(added.ok()) << added.error().to_string();
  EXPECT_EQ(added->tubes, 2);
  EXPECT_EQ(added->beads, 6);
  EXPECT_EQ(added->alone, 0);
  // Each stick begins where the one before ends, with the same radius, and the beads are among the ends.
  std::set<std::int64_t> through;
  const std::vector<std::int64_t> order{0, 2, 3, 5, 1, 4};
  std::size_t at = 0;
  for (std::int64_t k = 0; k < scene.sticks.size(); ++k) {
    const Stick one = tube_stick(scene, k);
    if (one.a == scene.spheres.centre(order[at])) through.insert(order[at]);
    if (one.b == scene.spheres.centre(order[std::min(at + 1, order.size() - 1)])) ++at;
    if (at < order.size()) through.insert(order[at]);
    EXPECT_EQ(one.radius_a, 0.25);
    const bool is_last = one.b == scene.spheres.centre(5) || one.b == scene.spheres.centre(4);
    if (is_last) {
      ++at;
      continue;
    }
    ASSERT_LT(k + 1, scene.sticks.size());
    EXPECT_EQ(tube_stick(scene, k + 1).a, one.b);
  }
  EXPECT_EQ(through.size(), 6);
  // The beads are hidden: their tube is seen in their place.
  for (std::int64_t id = 0; id < 6; ++id) EXPECT_EQ(scene.spheres.radius(id), 0);
  // Each half of the way looks like its bead.
  const std::int64_t first = scene.spheres.size();
  EXPECT_EQ(shown_sphere(scene, first), 0);
  std::vector<std::int64_t> shown;
  for (std::int64_t k = 0; k < scene.sticks.size(); ++k) {
    const std::int64_t sphere = shown_sphere(scene, first + 2 * k);
    if (shown.empty() || shown.back() != sphere) shown.push_back(sphere);
  }
  EXPECT_EQ(shown, order);
}

// Chords are near the curve: points of a circle give a tube near the circle.
TEST(Traces, are_round_between_the_beads) {
  std::vector<Place> places;
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * 3.14159265358979 * k / 24;
    places.push_back({10 * std::cos(angle), 10 * std::sin(angle), 0, 1});
  }
  Scene scene = beads(places);
  Traces traces = by_mol();
  traces.radius = "0.5";
  traces.atoms = TraceAtoms::shown;
  ASSERT_TRUE(add_traces(scene, traces).ok());
  EXPECT_EQ(scene.spheres.radius(0), 1);
  Vec3d before{};
  double largest_turn = 0;
  for (std::int64_t k = 0; k < scene.sticks.size(); ++k) {
    const Stick one = tube_stick(scene, k);
    // The ends of the run are straight, and beside them the curve is a little off the circle.
    for (const Vec3d& end : {one.a, 0.5 * (one.a + one.b)}) EXPECT_NEAR(length(end), 10, 0.06) << k;
    const Vec3d along = normalized(one.b - one.a);
    if (k > 0) largest_turn = std::max(largest_turn, std::acos(std::min(dot(before, along), 1.0)));
    before = along;
  }
  EXPECT_LT(largest_turn, 0.1);
}

TEST(Traces, have_the_radius_of_an_attribute) {
  Scene scene = beads({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}});
  Traces traces = by_mol();
  traces.radius = "0.1 + b/10";
  ASSERT_TRUE(add_traces(scene, traces).ok());
  EXPECT_FLOAT_EQ(static_cast<float>(tube_stick(scene, 0).radius_a), 0.1F);
  EXPECT_FLOAT_EQ(static_cast<float>(tube_stick(scene, scene.sticks.size() - 1).radius_b), 0.3F);
  for (std::int64_t k = 0; k < scene.sticks.size(); ++k)
    EXPECT_LT(tube_stick(scene, k).radius_a, tube_stick(scene, k).radius_b);
}

TEST(Traces, end_at_gaps) {
  Scene scene = beads({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}, {5, 0, 0, 1}, {6, 0, 0, 1}, {9, 0, 0, 1}});
  Traces traces = by_mol();
  traces.atoms = TraceAtoms::hidden;
  const Result<AddedTraces> added = add_traces(scene, traces);
  ASSERT_TRUE(added.ok());
  EXPECT_EQ(added->tubes, 2);
  EXPECT_EQ(added->beads, 5);
  EXPECT_EQ(added->alone, 1);
  EXPECT_EQ(scene.spheres.radius(5), 1) << "it is in no tube";
}

// Two residues with an alpha carbon each, calcium, and a water.
TEST(Traces, of_a_protein_go_through_its_alpha_carbons) {
  Scene scene = beads({{0, 0, 0, 1}, {1, 1, 0, 1}, {3.8, 0, 0, 1}, {4.8, 1, 0, 1}, {7, 0, 0, 1}, {9, 0, 0, 1}});
  SphereAttributes& attributes = scene.spheres.attributes();
  const auto texts = [&](const char* name, const std::vector<const char*>& values) {
    TextCollector collector;
    for (const char* const one : values) collector.add(one);
    attributes.texts.push_back(collector.take(name));
  };
  texts("name", {"CA", "CB", "CA", "CB", "CA", "O"});
  texts("resname", {"ALA", "ALA", "SER", "SER", "CA", "HOH"});
  texts("chain", {"A", "A", "A", "A", "A", "A"});
  attributes.numbers.push_back({"resid", {1, 1, 2, 2, 3, 4}});
  Traces traces;
  traces.by = TraceBy::chain;
  Scene jumping = scene;
  const Result<AddedTraces> added = add_traces(scene, traces);
  ASSERT_TRUE(added.ok()) << added.error().to_string();
  EXPECT_EQ(added->tubes, 1);
  EXPECT_EQ(added->beads, 2);
  // Their residues are hidden, calcium and water are not.
  EXPECT_EQ(scene.spheres.radius(1), 0);
  EXPECT_EQ(scene.spheres.radius(3), 0);
  EXPECT_EQ(scene.spheres.radius(4), 1);
  EXPECT_EQ(scene.spheres.radius(5), 1);
  // A residue is missing.
  jumping.spheres.attributes().numbers.back().values = {1, 1, 3, 3, 4, 5};
  EXPECT_EQ(add_traces(jumping, traces)->tubes, 0);
  EXPECT_EQ(jumping.spheres.radius(1), 1);
}

TEST(Traces, say_what_is_wrong) {
  const auto refused = [](auto change) {
    Scene scene = beads({{0, 0, 0, 1}, {1, 0, 0, 1}});
    Traces traces = by_mol();
    change(traces);
    const Result<AddedTraces> added = add_traces(scene, traces);
    EXPECT_FALSE(added.ok());
    return added ? "" : added.error().to_string();
  };
  EXPECT_THAT(refused([](Traces& t) { t.by = TraceBy::chain; }), HasSubstr("there is no attribute \"chain\""));
  EXPECT_THAT(refused([](Traces& t) { t.radius = "bb"; }), HasSubstr("no number, and there is no attribute \"bb\""));
  EXPECT_THAT(refused([](Traces& t) { t.radius = "b"; }), HasSubstr("must be above 0, and is not at sphere 0"));
  EXPECT_THAT(refused([](Traces& t) { t.radius = "-1"; }), HasSubstr("must be above 0"));
  EXPECT_THAT(refused([](Traces& t) { t.radius = "inf"; }), HasSubstr("trace_radius"));
  EXPECT_THAT(refused([](Traces& t) { t.select = "indx 1"; }), HasSubstr("trace_select"));
  Scene empty = beads({{0, 0, 0, 1}, {0, 0, 0, 2}});
  const Result<AddedTraces> alone = add_traces(empty, by_mol());
  ASSERT_TRUE(alone.ok());
  EXPECT_EQ(alone->tubes, 0);
  EXPECT_EQ(alone->alone, 2);
}

}  // namespace
}  // namespace bihive
