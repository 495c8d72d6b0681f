#include "bihive/io/bonds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/geometry/cell.h"
#include "bihive/io/elements.h"
#include "bihive/math/rng.h"
#include "bihive/scene/bonds.h"

namespace bihive {
namespace {

struct Atom {
  int element;
  double x, y, z;
};

SphereSet atoms(const std::vector<Atom>& list) {
  std::vector<double> x, y, z, r;
  std::vector<std::uint8_t> element;
  for (const Atom& atom : list) {
    x.push_back(atom.x);
    y.push_back(atom.y);
    z.push_back(atom.z);
    r.push_back(1.5);
    element.push_back(static_cast<std::uint8_t>(atom.element));
  }
  SphereSet spheres = SphereSet::from_world(x, y, z, r).value();
  spheres.attributes().element = element;
  return spheres;
}

// None of these goes to an image.
std::vector<SpherePair> pairs_of(const std::vector<ImagePair>& bonds) {
  std::vector<SpherePair> pairs;
  for (const ImagePair& bond : bonds) {
    EXPECT_FALSE(bond.is_image());
    pairs.push_back(bond.pair);
  }
  return pairs;
}

std::vector<SpherePair> bonds(const std::vector<Atom>& list, double reach = 1.2) {
  return pairs_of(bonds_by_distance(atoms(list), reach).value());
}

using Pairs = std::vector<SpherePair>;

constexpr int kH = 1, kC = 6, kN = 7, kO = 8, kUnknown = 0;

TEST(Bonds, of_two_waters) {
  // The hydrogen bond between them is 1.9 Å long, both hydrogen atoms of a molecule are 1.5 Å apart.
  EXPECT_EQ(bonds({{kO, 0, 0, 0},
                   {kH, 0.96, 0, 0},
                   {kH, -0.24, 0.93, 0},
                   {kO, 2.86, 0, 0},
                   {kH, 3.1, 0.93, 0},
                   {kH, 3.1, -0.93, 0}}),
            (Pairs{{0, 1}, {0, 2}, {3, 4}, {3, 5}}));
}

TEST(Bonds, reach_is_a_factor_of_the_sum_of_covalent_radii) {
  const double sum = covalent_radius(kC) + covalent_radius(kO);
  const std::vector<Atom> two{{kC, 0, 0, 0}, {kO, 1.5 * sum, 0, 0}};
  EXPECT_EQ(bonds(two, 1.49), Pairs{});
  EXPECT_EQ(bonds(two, 1.51), (Pairs{{0, 1}}));
}

TEST(Bonds, of_hydrogen_go_to_the_nearest_atom) {
  EXPECT_EQ(bonds({{kC, 0, 0, 0}, {kH, 1.1, 0, 0}, {kC, 2.25, 0, 0}}), (Pairs{{0, 1}}));
  EXPECT_EQ(bonds({{kH, 0, 0, 0}, {kH, 0.74, 0, 0}}), (Pairs{{0, 1}}));
}

TEST(Bonds, of_hydrogen_go_to_another_element_where_one_is_near) {
  // A water that was placed too close: its hydrogen atom is 0.66 Å from that of an amine.
  EXPECT_EQ(bonds({{kN, 24.93, 24.95, 18.87},
                   {kH, 25.66, 25.37, 18.33},
                   {kO, 26.41, 25.61, 17.15},
                   {kH, 25.60, 25.61, 17.72},
                   {kH, 26.41, 26.43, 16.57}}),
            (Pairs{{0, 1}, {2, 3}, {2, 4}}));
}

TEST(Bonds, between_atoms_in_one_place_or_of_unknown_element_there_are_none) {
  EXPECT_EQ(bonds({{kC, 1, 2, 3}, {kC, 1, 2, 3}, {kC, 2.5, 2, 3}}), (Pairs{{0, 2}, {1, 2}}));
  EXPECT_EQ(bonds({{kC, 0, 0, 0}, {kUnknown, 1.2, 0, 0}}), Pairs{});
  EXPECT_FALSE(bonds_by_distance(atoms({{kUnknown, 0, 0, 0}}), 1.2));
  SphereSet without = atoms({{kC, 0, 0, 0}});
  without.attributes().element.clear();
  EXPECT_FALSE(bonds_by_distance(without, 1.2));
}

TEST(Bonds, are_those_of_comparing_all_with_all) {
  for (const double side : {4.0, 12.0, 1e7}) {
    SplitMix64 rng(91);
    std::vector<Atom> list;
    for (int i = 0; i < 400; ++i)
      list.push_back({i % 5 == 0 ? kO : kC, side * rng.next_double(), 9 * rng.next_double(), 0.3 * rng.next_double()});
    const SphereSet spheres = atoms(list);
    Pairs expected;
    for (std::int32_t i = 0; i < 400; ++i)
      for (std::int32_t j = i + 1; j < 400; ++j) {
        const Vec3d between = spheres.local_centre(j) - spheres.local_centre(i);
        const double limit = 1.2 * (covalent_radius(list[static_cast<std::size_t>(i)].element) +
                                    covalent_radius(list[static_cast<std::size_t>(j)].element));
        if (dot(between, between) <= limit * limit) expected.push_back({i, j});
      }
    EXPECT_EQ(pairs_of(bonds_by_distance(spheres, 1.2).value()), expected) << side;
    if (side < 100) {
      EXPECT_GT(expected.size(), 100u);
    }
  }
}

Cell cell_with(Vec3d a, Vec3d b, Vec3d c) {
  Cell cell;
  cell.vectors = {a, b, c};
  return cell;
}

TEST(Bonds, go_to_the_images_of_a_periodic_cell) {
  SphereSet spheres = atoms({{kC, 0.5, 5, 5}, {kO, 9.3, 5, 5}, {kC, 5, 5, 5}});
  EXPECT_TRUE(bonds_by_distance(spheres, 1.2).value().empty());
  spheres.cell() = cell_with({10, 0, 0}, {0, 10, 0}, {0, 0, 10});
  EXPECT_EQ(bonds_by_distance(spheres, 1.2).value(), (std::vector<ImagePair>{{{0, 1}, {-1, 0, 0}}}));
  spheres.cell()->periodic = {false, true, true};
  EXPECT_TRUE(bonds_by_distance(spheres, 1.2).value().empty());
}

TEST(Bonds, a_cell_much_smaller_than_bonds_is_refused) {
  SphereSet spheres = atoms({{kC, 0, 0, 0}, {kO, 1.2, 0, 0}});
  spheres.cell() = cell_with({0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01});
  const auto bonds = bonds_by_distance(spheres, 1.2);
  ASSERT_FALSE(bonds);
  EXPECT_NE(bonds.error().message.find("periodic cell"), std::string::npos) << bonds.error().message;
  spheres.cell()->periodic = {false, false, false};
  EXPECT_EQ(bonds_by_distance(spheres, 1.2).value().size(), 1u);
}

TEST(Bonds, of_an_atom_to_its_own_images) {
  // A simple cubic crystal of one atom in a cell: three bonds, each with two ends.
  SphereSet spheres = atoms({{kC, 7, 7, 7}});
  spheres.cell() = cell_with({1.5, 0, 0}, {0, 1.5, 0}, {0, 0, 1.5});
  EXPECT_EQ(bonds_by_distance(spheres, 1.2).value(),
            (std::vector<ImagePair>{{{0, 0}, {0, 0, 1}}, {{0, 0}, {0, 1, 0}}, {{0, 0}, {1, 0, 0}}}));
}

// Skewed cells, smaller and larger than the longest bond, and atoms that lie outside of them.
TEST(Bonds, to_images_are_those_of_comparing_all_images) {
  const Cell cells[] = {cell_with({2, 0, 0}, {0.7, 2.5, 0}, {-0.9, 0.4, 3}), cell_with({9, 0, 0}, {4, 8, 0}, {0, 0, 0}),
                        cell_with({12, 0, 0}, {-5, 11, 0}, {3, 4, 10})};
  std::size_t bonds_to_images = 0;
  for (const Cell& cell : cells) {
    SplitMix64 rng(92);
    std::vector<Atom> list;
    const std::int32_t count = cell.vectors[0].x < 5 ? 3 : 60;
    for (std::int32_t i = 0; i < count; ++i) {
      Vec3d at = cell.vectors[2] == Vec3d{} ? Vec3d{0, 0, 5 * rng.next_double()} : Vec3d{};
      for (const Vec3d& vector : cell.vectors) at = at + (3 * rng.next_double() - 1) * vector;
      list.push_back({i % 3 == 0 ? kO : kC, at.x, at.y, at.z});
    }
    SphereSet spheres = atoms(list);
    spheres.cell() = cell;
    std::vector<ImagePair> expected;
    constexpr std::int64_t kMost = 7;
    for (std::int32_t i = 0; i < count; ++i)
      for (std::int32_t j = i; j < count; ++j)
        for (std::int64_t a = -kMost; a <= kMost; ++a)
          for (std::int64_t b = -kMost; b <= kMost; ++b)
            for (std::int64_t c = cell.vectors[2] == Vec3d{} ? 0 : -kMost;
                 c <= (cell.vectors[2] == Vec3d{} ? 0 : kMost); ++c) {
              const std::array<std::int64_t, 3> image{a, b, c};
              if (i == j && !(image > std::array<std::int64_t, 3>{})) continue;
              const Vec3d shift =
                  double(a) * cell.vectors[0] + double(b) * cell.vectors[1] + double(c) * cell.vectors[2];
              const Vec3d between = spheres.local_centre(j) + shift - spheres.local_centre(i);
              const double limit = 1.2 * (covalent_radius(list[static_cast<std::size_t>(i)].element) +
                                          covalent_radius(list[static_cast<std::size_t>(j)].element));
              if (dot(between, between) <= limit * limit) expected.push_back({{i, j}, image});
            }
    EXPECT_EQ(bonds_by_distance(spheres, 1.2, 1).value(), expected);
    EXPECT_EQ(bonds_by_distance(spheres, 1.2, 3).value(), expected);
    for (const ImagePair& bond : expected) bonds_to_images += bond.is_image() ? 1 : 0;
  }
  EXPECT_GT(bonds_to_images, 60u);
}

TEST(Bonds, of_a_file_go_to_the_nearest_image) {
  SphereSet spheres = atoms({{kUnknown, 0.5, 5, 5}, {kUnknown, 9.3, 5, 5}, {kUnknown, 5, 5, 5}});
  EXPECT_TRUE(bonds_of_file(spheres).empty());
  spheres.attributes().bonds.list = {{0, 1, BondOrder::single}, {1, 2, BondOrder::unknown}};
  EXPECT_EQ(pairs_of(bonds_of_file(spheres)), (Pairs{{0, 1}, {1, 2}}));
  spheres.cell() = cell_with({10, 0, 0}, {0, 10, 0}, {0, 0, 10});
  EXPECT_EQ(bonds_of_file(spheres), (std::vector<ImagePair>{{{0, 1}, {-1, 0, 0}}, {{1, 2}, {}}}));
  // In a flat skewed cell the nearest image need not be that of rounded shares.
  spheres.cell() = cell_with({10, 0, 0}, {9, 4, 0}, {0, 0, 10});
  SplitMix64 rng(93);
  for (int i = 0; i < 300; ++i) {
    SphereSet two = atoms({{kC, 40 * rng.next_double(), 40 * rng.next_double(), 0},
                           {kC, 40 * rng.next_double(), 40 * rng.next_double(), 0}});
    two.cell() = spheres.cell();
    two.attributes().bonds.list = {{0, 1, BondOrder::unknown}};
    const auto distance = [&](const std::array<std::int64_t, 3>& image) {
      const auto& [a, b, c] = two.cell()->vectors;
      return length(two.local_centre(1) - two.local_centre(0) + double(image[0]) * a + double(image[1]) * b);
    };
    double least = 1e9;
    for (std::int64_t a = -20; a <= 20; ++a)
      for (std::int64_t b = -20; b <= 20; ++b) least = std::min(least, distance({a, b, 0}));
    ASSERT_NEAR(distance(bonds_of_file(two).front().image), least, 1e-9);
  }
}

TEST(Bonds, come_from_the_file_where_it_states_all) {
  // A long bond that the file states, and a short distance that it does not.
  SphereSet spheres = atoms({{kC, 0, 0, 0}, {kC, 1.4, 0, 0}, {kC, 4, 0, 0}});
  spheres.attributes().bonds.list = {{1, 2, BondOrder::single}};
  EXPECT_EQ(pairs_of(automatic_bonds(spheres, 1.2).value()), (Pairs{{0, 1}, {1, 2}}));
  spheres.attributes().bonds.are_all = true;
  EXPECT_EQ(pairs_of(automatic_bonds(spheres, 1.2).value()), (Pairs{{1, 2}}));
  // Nor does it come from distances when the atoms of all stated bonds are hidden.
  spheres.attributes().bonds.list.clear();
  EXPECT_EQ(pairs_of(automatic_bonds(spheres, 1.2).value()), Pairs{});

  Scene scene;
  scene.spheres = spheres;
  Sticks sticks;
  sticks.bonds = Bonds::file;
  EXPECT_FALSE(find_bonds(scene, sticks));
  scene.spheres.attributes().bonds.list = {{0, 2, BondOrder::triple}};
  scene.spheres.attributes().element.clear();
  ASSERT_TRUE(scale_balls(scene, sticks));
  ASSERT_TRUE(find_bonds(scene, sticks));
  EXPECT_EQ(scene.sticks.pairs(), (Pairs{{0, 2}}));
  sticks.bonds = Bonds::distance;
  EXPECT_FALSE(scale_balls(scene, sticks));
}

TEST(Bonds, to_images_are_two_stubs) {
  Scene scene;
  scene.spheres = atoms({{kC, 0.5, 5, 5}, {kO, 9.5, 5, 5}});
  scene.spheres.cell() = cell_with({10, 0, 0}, {0, 10, 0}, {0, 0, 10});
  Sticks sticks;
  sticks.bonds = Bonds::distance;
  ASSERT_TRUE(find_bonds(scene, sticks));
  ASSERT_EQ(scene.sticks.size(), 2);
  const double scale = scene.spheres.scale();
  EXPECT_EQ(scene.sticks.stored(scene.spheres, 0).b, (scale * Vec3d{0, 5, 5}));
  EXPECT_EQ(scene.sticks.stored(scene.spheres, 1).b, (scale * Vec3d{10, 5, 5}));
  // Both halves of a stub look like its atom.
  for (const std::int64_t id : {2, 3}) EXPECT_EQ(shown_sphere(scene, id), 0);
  for (const std::int64_t id : {4, 5}) EXPECT_EQ(shown_sphere(scene, id), 1);
}

// A stub that ends far outside of the spheres: the units of the set make room for it.
TEST(Bonds, to_images_far_away_fit_the_stored_units) {
  SphereSet spheres = SphereSet::from_world(std::vector<double>{0}, {0}, {0}, {0.1}).value();
  EXPECT_FALSE(StickSet::between(spheres, {{{0, 0}, {1, 0, 0}}}, 0.05));
  spheres.cell() = cell_with({30, 0, 0}, {0, 30, 0}, {0, 0, 30});
  const Result<StickSet> made = StickSet::between(spheres, {{{0, 0}, {1, 0, 0}}}, 0.05);
  ASSERT_TRUE(made.ok());
  const Stick stub = made->stored(spheres, 0);
  EXPECT_EQ(stub.b * spheres.inverse_scale(), (Vec3d{15, 0, 0}));
  EXPECT_LE(stub.b.x, 1);
  EXPECT_EQ(spheres.radius(0), double(0.1F));
  EXPECT_FALSE(StickSet::between(spheres, {{{0, 1}, {1, 0, 0}}}, 0.05));
}

TEST(Bonds, become_sticks_of_the_scene) {
  Scene scene;
  scene.spheres = atoms({{kC, 0, 0, 0}, {kO, 1.2, 0, 0}, {kC, 9, 0, 0}});
  Sticks sticks;
  sticks.bonds = Bonds::distance;
  sticks.radius = 0.25;
  sticks.ball_scale = 0.5;
  ASSERT_TRUE(scale_balls(scene, sticks));
  EXPECT_EQ(scene.spheres.radius(2), 0.75);
  ASSERT_TRUE(find_bonds(scene, sticks));
  ASSERT_EQ(scene.sticks.size(), 1);
  EXPECT_EQ(scene.sticks.stored_radius() * scene.spheres.inverse_scale(), 0.25);
  EXPECT_EQ(shown_sphere(scene, 3), 0);
  EXPECT_EQ(shown_sphere(scene, 4), 1);
  EXPECT_EQ(shown_sphere(scene, 2), 2);
  // 0: as thick as the sticks.
  sticks.ball_scale = 0;
  ASSERT_TRUE(scale_balls(scene, sticks));
  EXPECT_EQ(scene.spheres.radius(2), 0.25);
  // Between atoms of different opacity there are two stubs.
  scene.spheres.attributes().opacity = {1, 0.5f, 1};
  ASSERT_TRUE(find_bonds(scene, sticks));
  ASSERT_EQ(scene.sticks.size(), 2);
  for (const std::int64_t id : {3, 4}) EXPECT_EQ(shown_sphere(scene, id), 0);
  for (const std::int64_t id : {5, 6}) EXPECT_EQ(shown_sphere(scene, id), 1);
  EXPECT_EQ(scene.sticks.stored(scene.spheres, 0).b, scene.sticks.stored(scene.spheres, 1).b);
  scene.spheres.attributes().opacity = {0.5f, 0.5f, 1};
  ASSERT_TRUE(find_bonds(scene, sticks));
  EXPECT_EQ(scene.sticks.size(), 1);
}

TEST(Bonds, a_stick_has_ends_and_a_radius) {
  const SphereSet spheres = atoms({{kC, 0, 0, 0}, {kO, 1.2, 0, 0}});
  EXPECT_FALSE(StickSet::between(spheres, {{0, 2}}, 0.1));
  EXPECT_FALSE(StickSet::between(spheres, {{-1, 1}}, 0.1));
  EXPECT_FALSE(StickSet::between(spheres, {{0, 1}}, 0));
  EXPECT_FALSE(StickSet::between(spheres, {{0, 1}}, 100));
  EXPECT_TRUE(StickSet::between(spheres, {}, 0));
}

}  // namespace
}  // namespace bihive
