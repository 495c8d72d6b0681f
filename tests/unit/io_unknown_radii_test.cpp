// Radii for files that give none: half the middle distance to the nearest neighbour.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "bihive/io/assemble/unknown_radii.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::read_text;
using testing::ElementsAre;
using testing::HasSubstr;

RawSpheres on_a_line(const std::vector<double>& x) {
  RawSpheres spheres;
  spheres.x = x;
  spheres.y = spheres.z = std::vector<double>(x.size());
  return spheres;
}

TEST(RadiusFromNeighbours, IsHalfTheLowerMedian) {
  EXPECT_EQ(radius_from_neighbours(on_a_line({0, 3}), {}), 1.5);
  EXPECT_EQ(radius_from_neighbours(on_a_line({0, 1, 3}), {}), 0.5) << "of 1 1 2";
  EXPECT_EQ(radius_from_neighbours(on_a_line({0, 1, 10, 14}), {}), 0.5)
      << "of 1 1 4 4: the lower of the two in the middle";
  EXPECT_EQ(radius_from_neighbours(on_a_line({0, 1, 10, 14, 18}), {}), 2) << "of 1 1 4 4 4";
}

TEST(RadiusFromNeighbours, CountsEqualPlacesAsOne) {
  EXPECT_EQ(radius_from_neighbours(on_a_line({7, 7, 7, 7, 11}), {}), 2);
  EXPECT_EQ(radius_from_neighbours(on_a_line({7, 7, 7}), {}), std::nullopt);
  EXPECT_EQ(radius_from_neighbours(on_a_line({7}), {}), std::nullopt);
  EXPECT_EQ(radius_from_neighbours(on_a_line({0.0, -0.0}), {}), std::nullopt);
}

TEST(RadiusFromNeighbours, IsExactWhereSquaresAreNot) {
  EXPECT_EQ(radius_from_neighbours(on_a_line({0, 0x1p-1000}), {}), 0x1p-1001);
  EXPECT_EQ(radius_from_neighbours(on_a_line({0, 2e38}), {}), 1e38);
  const double largest = std::numeric_limits<float>::max();
  RawSpheres corners = on_a_line({-largest, largest});
  corners.y = corners.z = corners.x;
  EXPECT_EQ(radius_from_neighbours(corners, {}), largest) << "larger ones are no radii";
}

// Of 131,072 spheres those with even ids are looked at. They lie 10 apart.
TEST(RadiusFromNeighbours, LooksAt65536SpheresEvenlyById) {
  RawSpheres spheres = on_a_line({});
  for (int i = 0; i < 65536; ++i) {
    spheres.x.push_back(10.0 * i);
    spheres.x.push_back(-100.0 - i);  // 1 apart
  }
  spheres.y = spheres.z = std::vector<double>(spheres.x.size());
  EXPECT_EQ(radius_from_neighbours(spheres, {}), 5);

  // Any sphere may be the neighbour.
  for (std::size_t i = 1; i < spheres.x.size(); i += 2) spheres.x[i] = spheres.x[i - 1] + 4;
  EXPECT_EQ(radius_from_neighbours(spheres, {}), 2);
}

TEST(UnknownRadii, AreHalfTheMiddleDistanceAndSaid) {
  const SphereFile file = read_text("0 0 0\n0 0 0.25\n0 0 4\n", "points.txt");
  for (int id = 0; id < 3; ++id) EXPECT_EQ(file.spheres.radius(id), 0.125);
  EXPECT_THAT(file.warnings,
              ElementsAre("no radii; each sphere gets radius 0.125, half the middle distance to the nearest neighbour; "
                          "radius sets another"));
  EXPECT_EQ(file.rules.back(), "radii: 0.125, half the middle distance to the nearest neighbour");
}

TEST(UnknownRadii, AreAHalfAtOnePlace) {
  const SphereFile file = read_text("1 2 3\n1 2 3\n", "points.txt");
  EXPECT_EQ(file.spheres.radius(1), 0.5);
  EXPECT_THAT(file.warnings,
              ElementsAre("no radii; each sphere gets radius 0.5, as all centres are at one place; radius sets "
                          "another"));
  EXPECT_EQ(file.rules.back(), "radii: 0.5, as all centres are at one place");
}

TEST(UnknownRadii, LeaveElementsAlone) {
  // The distances are 3, 3 and 5.
  const SphereFile file = read_text("3\n\nC 0 0 0\nbead 3 0 0\nC 8 0 0\n", "a.xyz");
  EXPECT_FLOAT_EQ(static_cast<float>(file.spheres.radius(0)), 1.7f);
  EXPECT_EQ(file.spheres.radius(1), 1.5);
  EXPECT_THAT(file.warnings,
              ElementsAre("1 sphere has neither element nor radius; each gets radius 1.5, half the middle distance to "
                          "the nearest neighbour; radius sets another"));
  EXPECT_THAT(file.rules.back(),
              "radii: 1.5 where neither element nor radius is known, half the middle distance to "
              "the nearest neighbour");
}

TEST(UnknownRadii, ComeBeforeTheOtherOptions) {
  ReadOptions options;
  options.radius_scale = 3;
  options.recenter = true;
  EXPECT_EQ(read_text("1e9 0 0\n1000000001 0 0\n", "points.txt", options).spheres.radius(0), 1.5);
  options.radius = 2;
  const SphereFile file = read_text("1e9 0 0\n1000000001 0 0\n", "points.txt", options);
  EXPECT_EQ(file.spheres.radius(0), 6);
  EXPECT_TRUE(file.warnings.empty());
}

TEST(UnknownRadii, OfAFilmAreThoseOfItsFirstFrame) {
  const std::string film = "2\n\nA 0 0 0\nA 2 0 0\n2\n\nA 0 0 0\nA 6 0 0\n";
  EXPECT_EQ(read_text(film, "a.xyz").spheres.radius(0), 1);
  const SphereFile second = read_text(film, "a.xyz", at_frame(1));
  EXPECT_EQ(second.spheres.centre(1).x, 6);
  EXPECT_EQ(second.spheres.radius(0), 1);
  EXPECT_THAT(second.warnings[0], HasSubstr("nearest neighbour in frame 0;"));

  const std::string model =
      "ATOM      1  X   BED A   1       0.000   0.000   0.000\n"
      "ATOM      2  X   BED A   2       2.000   0.000   0.000\nENDMDL\n";
  std::string models = model + model;
  models.replace(models.rfind("2.000"), 5, "6.000");
  EXPECT_EQ(read_text(models, "a.pdb", at_frame(1)).spheres.radius(0), 1);
}

TEST(UnknownRadii, OfAFilmAreEachFramesOwnIfTheFirstCannotTell) {
  const std::string second = "2\n\nA 0 0 0\nA 6 0 0\n";
  for (const std::string first : {"0\n\n", "1\n\nA 0 0 0\n", "2\n\nC 0 0 0\nC 2 0 0\n",
                                  "2\nProperties=pos:R:3:radius:R:1\n0 0 0 7\n2 0 0 7\n", "1\n\nA no number\n"}) {
    const SphereFile file = read_text(first + second, "a.xyz", at_frame(1));
    EXPECT_EQ(file.spheres.radius(0), 3) << first;
    EXPECT_EQ(file.warnings[0].find("frame 0"), std::string::npos) << first;
  }
}

}  // namespace
}  // namespace bihive
