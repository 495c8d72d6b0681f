#include "bihive/scene/hydrogen_bonds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "bihive/io/bonds.h"
#include "bihive/io/read_spheres.h"
#include "bihive/math/rng.h"
#include "bihive/scene/pair_line.h"

namespace bihive {
namespace {

constexpr int kH = 1, kC = 6, kN = 7, kO = 8;
constexpr double kPi = 3.14159265358979323846;

struct PolarAtom {
  int element;
  Vec3d centre;
};

SphereSet polar_atoms(const std::vector<PolarAtom>& list) {
  std::vector<double> x, y, z, r;
  std::vector<std::uint8_t> element;
  for (const PolarAtom& atom : list) {
    x.push_back(atom.centre.x);
    y.push_back(atom.centre.y);
    z.push_back(atom.centre.z);
    r.push_back(1.5);
    element.push_back(static_cast<std::uint8_t>(atom.element));
  }
  SphereSet spheres = SphereSet::from_world(x, y, z, r).value();
  spheres.attributes().element = element;
  return spheres;
}

using Lines = std::vector<std::array<std::int32_t, 2>>;
Lines lines_of(const SphereSet& spheres) {
  Lines lines;
  const std::vector<HydrogenBond> bonds = find_hydrogen_bonds(spheres).value();
  for (const HydrogenBond& bond : bonds) lines.push_back({bond.from, bond.acceptor});
  return lines;
}

// N-H ... O, the acceptor at a distance from the hydrogen atom and an angle there.
SphereSet donor_and_acceptor(double distance, double angle_deg) {
  const double angle = angle_deg * kPi / 180;
  return polar_atoms(
      {{kN, {0, 0, 0}}, {kH, {1, 0, 0}}, {kO, {1 - distance * std::cos(angle), distance * std::sin(angle), 0}}});
}

TEST(HydrogenBonds, by_the_distance_and_the_angle_at_the_hydrogen_atom) {
  EXPECT_EQ(lines_of(donor_and_acceptor(1.9, 180)), (Lines{{1, 2}}));
  EXPECT_EQ(lines_of(donor_and_acceptor(2.49, 121)), (Lines{{1, 2}}));
  EXPECT_EQ(lines_of(donor_and_acceptor(2.51, 170)), Lines{});
  EXPECT_EQ(lines_of(donor_and_acceptor(2.2, 119)), Lines{});
  // Carbon neither donates nor accepts.
  SphereSet spheres = donor_and_acceptor(1.9, 180);
  for (const std::size_t heavy : {0, 2}) {
    const auto before = spheres.attributes().element[heavy];
    spheres.attributes().element[heavy] = kC;
    EXPECT_EQ(lines_of(spheres), Lines{});
    spheres.attributes().element[heavy] = before;
  }
}

TEST(HydrogenBonds, between_waters_in_a_periodic_cell) {
  // O-H of one at the right side of the cell, O of the other at its left side.
  SphereSet spheres = polar_atoms({{kO, {9, 5, 5}}, {kH, {9.96, 5, 5}}, {kH, {8.76, 5.93, 5}}, {kO, {1.8, 5, 5}}});
  EXPECT_EQ(lines_of(spheres), Lines{});
  Cell cell;
  cell.vectors = {Vec3d{10, 0, 0}, Vec3d{0, 10, 0}, Vec3d{0, 0, 10}};
  cell.periodic = {true, true, true};
  spheres.cell() = cell;
  const std::vector<HydrogenBond> bonds = find_hydrogen_bonds(spheres).value();
  ASSERT_EQ(bonds.size(), 1U);
  EXPECT_EQ(bonds[0].from, 1);
  EXPECT_EQ(bonds[0].acceptor, 3);
  EXPECT_EQ(bonds[0].image, (ImageCounts{1, 0, 0}));

  Scene scene;
  scene.spheres = spheres;
  HydrogenBonds look;
  look.radius = 0.05;
  EXPECT_EQ(add_hydrogen_bonds(scene, look).value(), 1);
  ASSERT_GT(scene.sticks.size(), 2);
  // Stubs lie on either side of the cell.
  for (std::int64_t k = 0; k < scene.sticks.size(); ++k) {
    const Stick stick = scene.sticks.stored(scene.spheres, k);
    const double x = scene.spheres.inverse_scale() * stick.a.x;
    EXPECT_TRUE(scene.sticks.sphere_at(scene.spheres, 2 * k) == 1 ? x > 9.9 && x < 11 : x > 0.8 && x <= 1.81) << x;
  }
}

TEST(HydrogenBonds, without_hydrogen_atoms_by_the_distance_and_angles_at_both) {
  const auto pair = [](double distance, double degrees) {
    const double angle = degrees * kPi / 180;
    return polar_atoms({{kC, {1.4 * std::cos(angle), 1.4 * std::sin(angle), 0}},
                        {kN, {0, 0, 0}},
                        {kO, {distance, 0, 0}},
                        {kC, {distance + 1.2, 0, 0}}});
  };
  EXPECT_EQ(lines_of(pair(2.9, 120)), (Lines{{1, 2}}));
  EXPECT_EQ(lines_of(pair(3.49, 91)), (Lines{{1, 2}}));
  EXPECT_EQ(lines_of(pair(3.51, 120)), Lines{});
  EXPECT_EQ(lines_of(pair(2.9, 89)), Lines{});
  // Not between atoms that are bonded to one atom.
  EXPECT_EQ(lines_of(polar_atoms({{kC, {0, 0, 0}}, {kO, {1.25, 0, 0}}, {kO, {-0.6, 1.1, 0}}})), Lines{});
  EXPECT_FALSE(find_hydrogen_bonds(SphereSet::from_world(std::vector<double>{0}, {0}, {0}, {1}).value()));
}

// In a protein without hydrogen atoms carbonyl oxygen accepts, and nitrogen donates.
TEST(HydrogenBonds, know_the_atoms_of_proteins) {
  const auto line = [](const char* name, int id, double x, double y, const char* element, int residue) {
    char text[96];
    std::snprintf(text, sizeof text, "ATOM  %5d  %-3s ALA A%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", id, name,
                  residue, x, y, 0.0, element);
    return std::string(text);
  };
  const auto read = [&](const char* one, const char* of_one, const char* other, const char* of_other) {
    const std::string text = line("CA", 1, -1.5, 0, "C", 1) + line(one, 2, 0, 0, of_one, 1) +
                             line(other, 3, 2.9, 0, of_other, 7) + line("C", 4, 4.1, 0, "C", 7) + "END\n";
    return read_spheres_from_memory(text, "a.pdb", {}).value().spheres;
  };
  EXPECT_EQ(lines_of(read("N", "N", "O", "O")), (Lines{{1, 2}}));
  EXPECT_EQ(lines_of(read("O", "O", "N", "N")), (Lines{{2, 1}}));
  EXPECT_EQ(lines_of(read("O", "O", "O", "O")), Lines{});
  EXPECT_EQ(lines_of(read("N", "N", "N", "N")), Lines{});
}

// Against the definition, atom by atom.
TEST(HydrogenBonds, are_those_of_all_pairs) {
  SplitMix64 random(3);
  std::size_t count = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<PolarAtom> list;
    const auto at = [&] { return 9 * random.next_double(); };
    for (int i = 0; i < 120; ++i) {
      const int heavy = std::array<int, 3>{kC, kN, kO}[random.next() % 3];
      const Vec3d centre{at(), at(), at()};
      list.push_back({heavy, centre});
      if (round % 2 == 0 || heavy == kC) continue;
      const Vec3d aside = normalized(Vec3d{at() - 4.5, at() - 4.5, at() - 4.5});
      list.push_back({kH, centre + 0.98 * aside});
    }
    const SphereSet spheres = polar_atoms(list);
    const auto size = static_cast<std::int32_t>(list.size());
    std::vector<std::vector<std::int32_t>> near(list.size());
    const std::vector<ImagePair> bonds = bonds_by_distance(spheres, 1.2).value();
    for (const ImagePair& bond : bonds)
      for (const int k : {0, 1})
        near[static_cast<std::size_t>(bond.pair[std::size_t(k)])].push_back(bond.pair[std::size_t(1 - k)]);
    const auto centre = [&](std::int32_t id) { return spheres.local_centre(id); };
    const auto element = [&](std::int32_t id) { return int{spheres.attributes().element[std::size_t(id)]}; };
    const auto angle_at = [&](std::int32_t corner, std::int32_t a, std::int32_t b) {
      const Vec3d to_a = normalized(centre(a) - centre(corner)), to_b = normalized(centre(b) - centre(corner));
      return std::acos(dot(to_a, to_b)) * 180 / kPi;
    };
    std::set<std::array<std::int32_t, 2>> expected;
    for (std::int32_t donor = 0; donor < size; ++donor)
      for (std::int32_t acceptor = 0; acceptor < size; ++acceptor) {
        if (donor == acceptor || element(donor) < kN || element(acceptor) < kN) continue;
        bool by_bonds = false;
        for (const std::int32_t one : near[std::size_t(donor)]) {
          by_bonds = by_bonds || one == acceptor;
          for (const std::int32_t next : near[std::size_t(one)]) by_bonds = by_bonds || next == acceptor;
        }
        if (by_bonds) continue;
        if (round % 2 == 1) {
          for (const std::int32_t one : near[std::size_t(donor)])
            if (element(one) == kH && length(centre(one) - centre(acceptor)) <= 2.5 &&
                angle_at(one, donor, acceptor) >= 120)
              expected.insert({one, acceptor});
          continue;
        }
        bool open = donor < acceptor && length(centre(donor) - centre(acceptor)) <= 3.5;
        for (const std::int32_t one : near[std::size_t(donor)]) open = open && angle_at(donor, one, acceptor) >= 90;
        for (const std::int32_t one : near[std::size_t(acceptor)]) open = open && angle_at(acceptor, one, donor) >= 90;
        if (open) expected.insert({donor, acceptor});
      }
    const Lines found = lines_of(spheres);
    EXPECT_EQ(std::set(found.begin(), found.end()), expected) << round;
    EXPECT_EQ(found.size(), expected.size()) << round;
    count += found.size();
  }
  EXPECT_GT(count, 100U);
}

// A dash at either end, and gaps that nothing fills.
TEST(PairLines, dashes_begin_and_end_at_the_spheres) {
  const SphereSet spheres = SphereSet::from_world(std::vector<double>{0, 10}, {0, 0}, {0, 0}, {1, 1}).value();
  for (const double radius : {0.01, 0.1, 0.3, 1.0, 5.0}) {
    std::vector<OwnStick> sticks;
    add_pair_line(spheres, std::nullopt, {0, 1, {}, radius, {}, true}, sticks);
    double dashes = 0, covered = 0;
    Vec3d last{-1, 0, 0};
    std::vector<OwnStick> in_order = sticks;
    std::sort(in_order.begin(), in_order.end(),
              [](const OwnStick& a, const OwnStick& b) { return std::min(a.a.x, a.b.x) < std::min(b.a.x, b.b.x); });
    for (const OwnStick& one : in_order) {
      const double begin = std::min(one.a.x, one.b.x), end = std::max(one.a.x, one.b.x);
      EXPECT_EQ(one.sphere, begin < 5 ? 0 : 1);
      EXPECT_EQ(one.radius_a, radius);
      if (begin > last.x + 1e-9) ++dashes;
      covered += end - begin;
      last.x = end;
    }
    EXPECT_EQ(std::min(in_order.front().a.x, in_order.front().b.x), 0);
    EXPECT_EQ(std::max(in_order.back().a.x, in_order.back().b.x), 10);
    // About 3 of 8 radii.
    EXPECT_NEAR(dashes, std::max(1.0, (10 / radius + 5) / 8), 0.51) << radius;
    EXPECT_NEAR(covered, 10 * 3 * dashes / (8 * dashes - 5), 1e-6) << radius;
  }
}

}  // namespace
}  // namespace bihive
