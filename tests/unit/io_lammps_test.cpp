#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::number_names;
using test::numbers_of;
using test::read_text;

std::string frame(const std::string& columns, const std::string& atoms, int count,
                  const std::string& box = "ITEM: BOX BOUNDS pp pp pp\n-1 1\n0 4\n10 20\n") {
  return "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n" + std::to_string(count) + "\n" + box + "ITEM: ATOMS " +
         columns + "\n" + atoms;
}

TEST(LammpsDump, TakesColumnsByName) {
  const SphereFile file = read_text(
      frame("id type x y z radius vx element name", "3 2 0.5 1.5 2.5 0.25 -1 Si a \n7 1 1 2 3 0.75 1e-3 O b \n", 2),
      "dump.anything");
  EXPECT_EQ(file.format, "LAMMPS dump");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{0.5, 1.5, 2.5}));
  EXPECT_EQ(file.spheres.radius(1), 0.75);
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{2, 1}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{14, 8}));
  EXPECT_EQ(number_names(file), (std::vector<std::string>{"id", "vx"}));
  EXPECT_EQ(numbers_of(file, "id"), (std::vector<double>{3, 7}));
  EXPECT_TRUE(file.warnings.empty());
}

TEST(LammpsDump, HalvesADiameterAndGuessesARadius) {
  EXPECT_EQ(read_text(frame("diameter x y z", "3 0 0 0\n", 1), "d").spheres.radius(0), 1.5);
  const SphereFile bare = read_text(frame("type x y z", "3 0 0 0\n3 0 0 6\n", 2), "d");
  EXPECT_EQ(bare.spheres.radius(0), 1);  // half the way to its own image along x
  ASSERT_EQ(bare.warnings.size(), 1u);
  EXPECT_NE(bare.warnings[0].find("radius sets another"), std::string::npos);
}

TEST(LammpsDump, BringsScaledCoordinatesIntoAnOrthogonalBox) {
  for (const char* columns : {"xs ys zs", "xsu ysu zsu"}) {
    const SphereFile file = read_text(frame(columns, "0.25 0.5 0.75\n1.5 -1 0\n", 2), "d");
    EXPECT_EQ(file.spheres.centre(0), (Vec3d{-0.5, 2, 17.5})) << columns;
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{2, -4, 10})) << columns;
  }
}

TEST(LammpsDump, TakesUnwrappedCoordinatesAndPrefersPlainOnes) {
  EXPECT_EQ(read_text(frame("xu yu zu", "7 8 9\n", 1), "d").spheres.centre(0), (Vec3d{7, 8, 9}));
  const SphereFile both = read_text(frame("xs ys zs x y z", "0 0 0 1 2 3\n", 1), "d");
  EXPECT_EQ(both.spheres.centre(0), (Vec3d{1, 2, 3}));
  EXPECT_EQ(number_names(both), (std::vector<std::string>{"xs", "ys", "zs"}));
}

TEST(LammpsDump, TakesTheTiltOutOfTriclinicBounds) {
  // A box with lo (0, 0, 0), hi (10, 8, 6) and the tilts xy 2, xz -3, yz 1 has these bounds around it.
  const std::string box = "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-3 12 2\n0 9 -3\n0 6 1\n";
  const SphereFile file = read_text(frame("xs ys zs", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.5 0.5 0.5\n", 5, box), "d");
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{0, 0, 0}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{10, 0, 0}));
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{2, 8, 0}));
  EXPECT_EQ(file.spheres.centre(3), (Vec3d{-3, 1, 6}));
  EXPECT_EQ(file.spheres.centre(4), (Vec3d{4.5, 4.5, 3}));
}

TEST(LammpsDump, TakesAlongWhichVectorsTheBoxIsPeriodic) {
  const auto flags = [](const std::string& words) {
    const std::string numbers =
        words.find("abc") != std::string::npos ? "1 0 0 0\n0 1 0 0\n0 0 1 0\n" : "0 1 0\n0 1 0\n0 1 0\n";
    return read_text(frame("x y z", "0 0 0\n", 1, "ITEM: BOX BOUNDS" + words + "\n" + numbers), "d")
        .spheres.cell()
        ->periodic;
  };
  EXPECT_EQ(flags(" pp pp ff"), (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(flags(" xy xz yz ss pp fm"), (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(flags(" abc origin pp ff pp"), (std::array<bool, 3>{true, false, true}));
  for (const char* unstated : {"", " xy xz yz", " pp pp", " pp pp nonsense"})
    EXPECT_EQ(flags(unstated), (std::array<bool, 3>{true, true, true})) << unstated;
}

TEST(LammpsDump, TakesAGeneralTriclinicBox) {
  const std::string box = "ITEM: BOX BOUNDS abc origin pp pp pp\n1 2 0 5\n0 3 0 6\n0 0 4 7\n";
  const SphereFile file = read_text(frame("xs ys zs", "0.5 0.25 1\n", 1, box), "d");
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{5.5, 7.75, 11}));
}

TEST(LammpsDump, TakesTheFrameAskedForAndOtherSections) {
  const std::string text = "ITEM: UNITS\nlj\n" + frame("x y z", "1 0 0\n", 1) + "ITEM: TIME\n0.5\n" +
                           frame("y x z type", "0 2 0 1\n0 3 0 1\n", 2) + "\n" + frame("x y z", "", 0);
  EXPECT_EQ(read_text(text, "d").frames, 3);
  EXPECT_EQ(read_text(text, "d").spheres.centre(0), (Vec3d{1, 0, 0}));
  EXPECT_EQ(read_text(text, "d", at_frame(1)).spheres.centre(1), (Vec3d{3, 0, 0}));
  EXPECT_EQ(error_of(text, "d", at_frame(2)), "d: there are no spheres in frame 2 (read as LAMMPS dump)");
  EXPECT_EQ(error_of(text, "d", at_frame(3)),
            "d: there is no frame 3: the file has 3 (0 to 2); choose one with frame, counting from 0");
}

TEST(LammpsDump, TakesTheTime) {
  const auto timed = [](const std::string& units, const std::string& time) {
    return (units.empty() ? "" : "ITEM: UNITS\n" + units + "\n") + "ITEM: TIME\n1\n" + frame("x y z", "1 0 0\n", 1) +
           "ITEM: TIME\n" + time + "\n" + frame("x y z", "1 0 0\n", 1);
  };
  for (const auto& [units, time, rule] : {std::tuple{"real", 2.5, "time: picoseconds, from units real"},
                                          {"metal", 2500, "time: picoseconds, from units metal"},
                                          {"nano", 2500e3, "time: picoseconds, from units nano"},
                                          {"lj", 2500, "time: as it stands there, in units lj"},
                                          {"", 2500, "time: taken as picoseconds, as the file names no units"}}) {
    const SphereFile file = read_text(timed(units, "2500"), "d", at_frame(1));
    EXPECT_EQ(file.time_ps, time) << units;
    EXPECT_NE(std::find(file.rules.begin(), file.rules.end(), rule), file.rules.end()) << units;
    EXPECT_EQ(file.step, 100);
  }
  EXPECT_FALSE(read_text(frame("x y z", "1 0 0\n", 1), "d").time_ps.has_value());
  EXPECT_EQ(error_of(timed("metal", "now"), "d"), "d:16:1: expected the time but found 'now'");
}

TEST(LammpsDump, NamesTheLineWhereItIsCut) {
  const std::string whole = frame("id x y z", "1 1 2 3\n2 4 5 6\n", 2);
  const std::string two = whole + whole;
  EXPECT_EQ(error_of(whole.substr(0, whole.size() - 8), "d"),
            "d:10: the file ends in frame 0: expected 2 atoms (line 4) but found 1");
  EXPECT_EQ(error_of(two.substr(0, two.size() - 8), "d"),
            "d:21: the file ends in frame 1: expected 2 atoms (line 15) but found 1");
  EXPECT_EQ(error_of(two.substr(0, two.size() - 3), "d"),
            "d:22: expected 4 columns (id x y z) but found 3; the file is cut on this line");
  EXPECT_EQ(error_of(whole.substr(0, whole.find("ITEM: ATOMS")), "d"),
            "d:8: the file ends in frame 0: expected ITEM: ATOMS and one line an atom");

  // The second frame is cut at every place. Each cut is an error, except at its last line end or inside its last
  // number.
  for (std::size_t size = whole.size() + 1; size + 2 < two.size(); ++size)
    EXPECT_FALSE(error_of(two.substr(0, size), "d").empty()) << "cut at " << size;

  // A missing line end is the only sign of a cut inside the last number.
  const SphereFile no_end = read_text(two.substr(0, two.size() - 1), "d");
  EXPECT_EQ(no_end.warnings.size(), 2u);
  EXPECT_EQ(no_end.warnings[0], "the last line of d has no end: the file may be cut");
}

TEST(LammpsDump, NeverBelievesACount) {
  std::string text = frame("x y z", "1 2 3\n", 1);
  text.replace(text.find("ATOMS\n1\n") + 6, 1, "100000000000");
  EXPECT_EQ(error_of(text, "d"), "d:10: the file ends in frame 0: expected 100000000000 atoms (line 4) but found 1");
  EXPECT_EQ(error_of("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1e11\n", "d"),
            "d:4:1: expected the number of atoms but found '1e11'");
  EXPECT_EQ(error_of("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n-1\n", "d"),
            "d:4:1: expected the number of atoms but found '-1'");
}

TEST(LammpsDump, NamesLineAndColumnOfAFault) {
  EXPECT_EQ(error_of(frame("id x y z", "1 1 2 3\n2 4 inf 6\n", 2), "d"), "d:11:5: y is not finite: 'inf'");
  EXPECT_EQ(error_of(frame("id x y z", "1 1 2 3\n2 4 5..1 6\n", 2), "d"),
            "d:11:5: expected a number for y but found '5..1'");
  EXPECT_EQ(error_of(frame("x y z radius", "1 2 3 -4\n", 1), "d"), "d:10:7: radius is negative: '-4'");
  EXPECT_EQ(error_of(frame("id x y z", "1 1 2 3 4\n", 1), "d"),
            "d:10:9: expected 4 columns (id x y z) but found one more: '4'");
  EXPECT_EQ(error_of(frame("id x y", "1 1 2\n", 1), "d"),
            "d:9: expected columns x y z, xu yu zu, xs ys zs or xsu ysu zsu but found 'id x y'");
  EXPECT_EQ(error_of(frame("xs ys zs", "1 1 2\n", 1, ""), "d"),
            "d:5: scaled coordinates need ITEM: BOX BOUNDS before them");
  EXPECT_EQ(error_of(frame("x y z", "1 1 2\n", 1, "ITEM: BOX BOUNDS pp pp pp\n0 1\n0\n0 1\n"), "d"),
            "d:7:2: expected 2 numbers of the box but found ''");
  EXPECT_EQ(error_of("ITEM: TIMESTEP\n1\nITEM: ATOMS x y z\n1 2 3\n", "d"),
            "d:3: expected ITEM: NUMBER OF ATOMS before ITEM: ATOMS");
  EXPECT_EQ(error_of("ITEM: TIMESTEP\n1\nITEM: TIMESTEP\n2\n", "d"),
            "d:3: expected ITEM: ATOMS of frame 0 before the next frame");
  EXPECT_EQ(error_of("ITEM: TIMESTEP\nsoon\n", "d"), "d:2:1: expected the time step but found 'soon'");
  EXPECT_EQ(error_of(frame("x y z", "1 2 3\n", 1) + "ITEM: ENTRIES a b\n", "d"),
            "d:11: expected ITEM: TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS or ATOMS but found 'ITEM: ENTRIES a b'");
  EXPECT_EQ(error_of(frame("x y z", "1 2 3\n4 5 6\n", 1), "d"),
            "d:11: expected a line that begins with 'ITEM:' but found '4 5 6'");
}

}  // namespace
}  // namespace bihive
