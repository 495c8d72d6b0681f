#include "bihive/scene/bond_orders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/scene/bonds.h"
#include "support/read_text.h"

namespace bihive {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 0.125;
constexpr BondOrder kOne = BondOrder::single, kTwo = BondOrder::double_bond, kThree = BondOrder::triple,
                    kRing = BondOrder::aromatic;

struct OrderedBond {
  std::int32_t one, other;
  BondOrder order;
};

// Sticks of points and their bonds.
struct Molecule {
  SphereSet spheres;
  std::vector<ImagePair> bonds;
  std::vector<BondOrder> orders;

  Molecule(const std::vector<Vec3d>& points, const std::vector<OrderedBond>& list) {
    std::vector<double> x, y, z;
    for (const Vec3d& at : points) {
      x.push_back(at.x);
      y.push_back(at.y);
      z.push_back(at.z);
    }
    spheres = SphereSet::from_world(x, y, z, std::vector<double>(x.size(), 0.5)).value();
    for (const OrderedBond& one : list) {
      bonds.push_back({{one.one, one.other}, {}});
      orders.push_back(one.order);
    }
  }

  std::vector<OwnStick> sticks() const { return parallel_sticks(spheres, bonds, orders, kRadius); }
  Vec3d at(std::int32_t id) const { return spheres.local_centre(id); }
};

double distance_to_line(Vec3d point, Vec3d a, Vec3d b) {
  const Vec3d along = normalized(b - a), apart = point - a;
  return length(apart - dot(apart, along) * along);
}

const std::vector<Vec3d> kEthene{{0, 0, 0}, {1.34, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {1.84, 0.9, 0}};

TEST(BondOrders, a_double_bond_is_two_sticks_in_the_plane_of_its_neighbours) {
  const Molecule ethene(kEthene, {{0, 1, kTwo}, {0, 2, kOne}, {0, 3, kOne}, {1, 4, kOne}});
  const std::vector<OwnStick> sticks = ethene.sticks();
  ASSERT_EQ(sticks.size(), 2U);
  for (const OwnStick& one : sticks) {
    EXPECT_EQ(one.sphere, 0);
    EXPECT_EQ(one.other, 1);
    EXPECT_EQ(one.radius_a, kDoubleBond.radius * kRadius);
    EXPECT_EQ(one.radius_b, one.radius_a);
    EXPECT_EQ(one.a.z, ethene.at(0).z);
    EXPECT_EQ(one.a.x, ethene.at(0).x);
    EXPECT_EQ(one.b.x, ethene.at(1).x);
    EXPECT_NEAR(distance_to_line(one.a, ethene.at(0), ethene.at(1)), kDoubleBond.spacing * kRadius / 2, 1e-12);
  }
  EXPECT_LT(sticks[0].a.y, ethene.at(0).y);
  EXPECT_GT(sticks[1].a.y, ethene.at(0).y);
}

TEST(BondOrders, single_and_unknown_bonds_have_no_parallel_sticks) {
  EXPECT_TRUE(Molecule(kEthene, {{0, 1, kOne}, {0, 2, BondOrder::unknown}}).sticks().empty());
}

TEST(BondOrders, a_triple_bond_has_a_stick_on_the_axis) {
  // No atom lies off the axis: the plane holds the world axis that is most across, of equal ones the first.
  const std::vector<OwnStick> sticks =
      Molecule({{0, 0, 0}, {0, 0, 1.1}, {0, 0, 2.6}}, {{0, 1, kThree}, {1, 2, kOne}}).sticks();
  ASSERT_EQ(sticks.size(), 3U);
  const double step = kTripleBond.spacing * kRadius;
  for (int k = 0; k < 3; ++k) {
    const OwnStick& one = sticks[static_cast<std::size_t>(k)];
    EXPECT_DOUBLE_EQ(one.a.x - sticks[1].a.x, (k - 1) * step);
    EXPECT_EQ(one.a.y, sticks[1].a.y);
    EXPECT_EQ(one.radius_a, kTripleBond.radius * kRadius);
  }
}

TEST(BondOrders, the_plane_of_a_linear_piece_is_that_of_the_next_atoms_off_it) {
  // But-2-yne: a hydrogen atom of a methyl group, two bonds away, lies in the plane.
  const std::vector<OwnStick> sticks =
      Molecule({{0, 0, 0}, {1.2, 0, 0}, {-1.5, 0, 0}, {2.7, 0, 0}, {3, 0, 1}, {-1.8, 1, 0}},
               {{0, 1, kThree}, {0, 2, kOne}, {1, 3, kOne}, {2, 5, kOne}, {3, 4, kOne}})
          .sticks();
  ASSERT_EQ(sticks.size(), 3U);
  EXPECT_NEAR(std::abs(sticks[2].a.y - sticks[1].a.y), kTripleBond.spacing * kRadius, 1e-12);
  EXPECT_EQ(sticks[2].a.z, sticks[1].a.z);
  // A neighbour that lies off by less than ten degrees does not count.
  const std::vector<OwnStick> bent =
      Molecule({{0, 0, 0}, {1.2, 0, 0}, {-1.5, 0.2, 0}, {2.7, 0, 1}}, {{0, 1, kTwo}, {0, 2, kOne}, {1, 3, kOne}})
          .sticks();
  ASSERT_EQ(bent.size(), 2U);
  EXPECT_EQ(bent[0].a.y, bent[1].a.y);
}

std::vector<Vec3d> hexagon(Vec3d centre) {
  std::vector<Vec3d> points;
  for (int k = 0; k < 6; ++k) points.push_back(centre + 1.4 * Vec3d{std::cos(kPi / 3 * k), std::sin(kPi / 3 * k), 0});
  return points;
}
const std::vector<OrderedBond> kBenzene{{0, 1, kRing}, {0, 5, kRing}, {1, 2, kRing},
                                        {2, 3, kRing}, {3, 4, kRing}, {4, 5, kRing}};

TEST(BondOrders, an_aromatic_bond_has_dashes_inside_its_ring) {
  const Molecule benzene(hexagon({5, 6, 7}), kBenzene);
  const Vec3d centre = benzene.spheres.to_local({5, 6, 7});
  const double spacing = kAromaticBond.spacing * kRadius, of_axes = 1.4 * std::cos(kPi / 6);
  int solid = 0;
  double nearest_to_bisector = 1;
  for (const OwnStick& one : benzene.sticks()) {
    const Vec3d a = one.a, b = one.b;
    const bool is_solid = length(b - a) > 1.3;
    solid += is_solid;
    const double expected = is_solid ? of_axes : of_axes - spacing;
    EXPECT_NEAR(distance_to_line(centre, a, b), expected, 1e-6);
    EXPECT_NEAR(a.z, centre.z, 1e-6);
    // No dash goes beyond the ring of this size, whose corners lie on the lines from the atoms to the centre.
    EXPECT_LT(length(a - centre), 1.4 * expected / of_axes + 1e-6);
    EXPECT_LT(length(b - centre), 1.4 * expected / of_axes + 1e-6);
    if (!is_solid) nearest_to_bisector = std::min(nearest_to_bisector, 1.4 * expected / of_axes - length(a - centre));
  }
  EXPECT_EQ(solid, 6);
  EXPECT_NEAR(nearest_to_bisector, 0, 1e-6);
}

TEST(BondOrders, a_dash_in_the_middle_has_both_colours_and_others_one) {
  const Molecule benzene(hexagon({0, 0, 0}), kBenzene);
  int joined = 0, of_one = 0;
  for (const OwnStick& one : benzene.sticks()) {
    joined += one.sphere == 0 && one.other == 1;
    of_one += one.other < 0;
  }
  EXPECT_EQ(joined, 2);  // the solid stick, and the dash in the middle
  EXPECT_EQ(of_one, 6 * 4);
}

TEST(BondOrders, the_smallest_ring_counts) {
  // Azulene's shared bond lies in a ring of five and one of seven. A bond in no aromatic ring takes the plane's side.
  std::vector<Vec3d> points{{0, 0.7, 0},    {0, -0.7, 0},   {1.33, -1.13, 0}, {2.15, 0, 0},    {1.33, 1.13, 0},
                            {-1.1, 1.6, 0}, {-2.4, 1.3, 0}, {-3, 0, 0},       {-2.4, -1.3, 0}, {-1.1, -1.6, 0}};
  const std::vector<OrderedBond> azulene{{0, 1, kRing}, {0, 4, kRing}, {0, 5, kRing}, {1, 2, kRing},
                                         {1, 9, kRing}, {2, 3, kRing}, {3, 4, kRing}, {5, 6, kRing},
                                         {6, 7, kRing}, {7, 8, kRing}, {8, 9, kRing}};
  const Molecule both(points, azulene);
  const std::vector<OwnStick> sticks = both.sticks();
  ASSERT_GT(sticks.size(), 2U);
  EXPECT_GT(sticks[1].a.x, both.at(0).x);  // towards the ring of five

  const std::vector<OwnStick> carboxylate =
      Molecule({{0, 0, 0}, {1.2, 0.5, 0}, {-1.2, 0.5, 0}}, {{0, 1, kRing}, {0, 2, kRing}}).sticks();
  ASSERT_GT(carboxylate.size(), 2U);
  EXPECT_GT(carboxylate[1].a.y, carboxylate[0].a.y);
  EXPECT_EQ(carboxylate[1].a.z, carboxylate[0].a.z);
}

TEST(BondOrders, a_bond_to_an_image_has_stubs_and_a_parted_one_two_parts) {
  Molecule across({{0.25, 5, 5}, {9.25, 5, 5}, {0.25, 6, 5}}, {{0, 1, kTwo}, {0, 2, kOne}});
  across.bonds[0].image = {-1, 0, 0};
  Cell cell;
  cell.vectors = {Vec3d{10, 0, 0}, Vec3d{0, 10, 0}, Vec3d{0, 0, 10}};
  across.spheres.cell() = cell;
  const std::vector<OwnStick> stubs = across.sticks();
  ASSERT_EQ(stubs.size(), 4U);
  for (const OwnStick& one : stubs) {
    EXPECT_LT(one.other, 0);
    EXPECT_NEAR(length(one.b - one.a), 0.5, 1e-12);
    EXPECT_NEAR(std::abs(one.a.y - across.at(0).y), kDoubleBond.spacing * kRadius / 2, 1e-12);
  }
  EXPECT_EQ(stubs[0].sphere, 0);
  EXPECT_EQ(stubs[0].a.x, across.at(0).x);
  EXPECT_EQ(stubs[1].sphere, 1);
  EXPECT_EQ(stubs[1].b.x, across.at(1).x);

  const Molecule ethene(kEthene, {{0, 1, kTwo}, {0, 2, kOne}});
  const std::vector<OwnStick> parts =
      parallel_sticks(ethene.spheres, ethene.bonds, ethene.orders, kRadius, [](const SpherePair&) { return true; });
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[0].b.x, parts[1].a.x);
  EXPECT_EQ(parts[1].sphere, 1);
}

const std::string kFormaldehyde =
    "CH2O\n\n\n  4  3  0  0  0  0            999 V2000\n    0.0000    0.0000    0.0000 C   0  0\n"
    "    1.2000    0.0000    0.0000 O   0  0\n   -0.5500    0.9500    0.0000 H   0  0\n"
    "   -0.5500   -0.9500    0.0000 H   0  0\n  1  2  2  0\n  1  3  1  0\n  1  4  1  0\nM  END\n";

TEST(BondOrders, those_of_a_file_are_drawn_where_they_are_asked_for) {
  const auto sticks_with = [](Bonds bonds, bool orders) {
    Scene scene;
    scene.spheres = test::read_text(kFormaldehyde, "a.sdf").spheres;
    Sticks sticks;
    sticks.bonds = bonds;
    sticks.orders = orders;
    EXPECT_TRUE(find_bonds(scene, sticks));
    return scene.sticks;
  };
  const StickSet whole = sticks_with(Bonds::file, false);
  EXPECT_EQ(whole.size(), 3);
  EXPECT_EQ(whole.own_count(), 0);
  EXPECT_TRUE(sticks_with(Bonds::distance, true) == sticks_with(Bonds::distance, false));
  for (const Bonds bonds : {Bonds::file, Bonds::automatic}) {
    const StickSet parallel = sticks_with(bonds, true);
    EXPECT_EQ(parallel.size(), 4);
    EXPECT_EQ(parallel.own_count(), 2);
    const SphereSet spheres = test::read_text(kFormaldehyde, "a.sdf").spheres;
    EXPECT_EQ(parallel.sphere_at(spheres, 2 * 2), 0);
    EXPECT_EQ(parallel.sphere_at(spheres, 2 * 2 + 1), 1);
  }
}

}  // namespace
}  // namespace bihive
