#include <gtest/gtest.h>

#include <algorithm>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;

const std::string kWater =
    "LAMMPS data file via write_data, version 23 Jun 2022, timestep = 4000\n"
    "\n"
    "3 atoms\n"
    "2 atom types\n"
    "2 bonds\n"
    "\n"
    "-1.5 8.5 xlo xhi\n"
    "0 20 ylo yhi # a comment\n"
    "0 30 zlo zhi\n"
    "1 2 3 xy xz yz\n"
    "\n"
    "Masses\n"
    "\n"
    "1 15.9994 # OW\n"
    "2 1.008\n"
    "\n"
    "Pair Coeffs # lj/cut\n"
    "\n"
    "1 0.1 3.0\n"
    "\n"
    "Atoms # full\n"
    "\n"
    "1 7 1 -0.8 1.0 2.0 3.0 1 0 -1\n"
    "2 7 2 0.4 1.5 2.5 3.5 0 0 0 # behind\n"
    "3 7 2 0.4 -1.0 2.0 4.0 0 0 0\n"
    "\n"
    "Velocities\n"
    "\n"
    "1 0 0 0\n2 0 0 0\n3 0 0 0\n"
    "\n"
    "Bonds\n"
    "\n"
    "1 1 1 2\n2 1 1 3\n";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kWater;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

bool has_rule(const SphereFile& file, const std::string& part) {
  for (const std::string& rule : file.rules)
    if (rule.find(part) != std::string::npos) return true;
  return false;
}

TEST(LammpsData, TakesAtomsOfTheStatedStyle) {
  const SphereFile file = read_text(kWater, "w.data");
  EXPECT_EQ(file.format, "LAMMPS data");
  EXPECT_EQ(file.frames, 1);
  EXPECT_EQ(*file.step, 4000);
  ASSERT_EQ(file.spheres.size(), 3);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{1.5, 2.5, 3.5}));
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 2}));
  EXPECT_EQ(numbers_of(file, "q"), (std::vector<double>{-0.8, 0.4, 0.4}));
  EXPECT_EQ(numbers_of(file, "mol"), (std::vector<double>{7, 7, 7}));
  EXPECT_EQ(numbers_of(file, "id"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(numbers_of(file, "iz"), (std::vector<double>{-1, 0, 0}));
  EXPECT_TRUE(has_rule(file, "atom style: full (id mol type q x y z ix iy iz)"));
}

TEST(LammpsData, TakesTheTiltedBoxAndUnwraps) {
  const SphereFile file = read_text(kWater, "w.data");
  ASSERT_TRUE(file.spheres.cell().has_value());
  EXPECT_EQ(file.spheres.cell()->origin, (Vec3d{-1.5, 0, 0}));
  EXPECT_EQ(file.spheres.cell()->vectors, (std::array<Vec3d, 3>{Vec3d{10, 0, 0}, Vec3d{1, 20, 0}, Vec3d{2, 3, 30}}));
  ReadOptions options;
  options.wrapping = Wrapping::unwrap;
  EXPECT_EQ(read_text(kWater, "w.data", options).spheres.centre(0), (Vec3d{1 + 10 - 2, 2 - 3, 3 - 30}));
  const SphereFile general =
      read_text(with("-1.5 8.5 xlo xhi\n0 20 ylo yhi # a comment\n0 30 zlo zhi\n1 2 3 xy xz yz\n",
                     "1 2 3 avec\n4 5 6 bvec\n7 8 10 cvec\n-1 -2 -3 abc origin\n"),
                "w.data");
  EXPECT_EQ(general.spheres.cell()->origin, (Vec3d{-1, -2, -3}));
  EXPECT_EQ(general.spheres.cell()->vectors[1], (Vec3d{4, 5, 6}));
}

TEST(LammpsData, InfersElementsOnlyFromMassesOfElements) {
  const SphereFile file = read_text(kWater, "w.data");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{8, 1, 1}));
  EXPECT_TRUE(has_rule(file, "elements: inferred from the masses, as the file states none: type 1 (15.9994) O, 2"));
  // One mass that no element has, whole numbers, and units without a mass of their own.
  EXPECT_TRUE(read_text(with("1 15.9994 # OW", "1 72.1"), "w").spheres.attributes().element.empty());
  EXPECT_TRUE(read_text(with("1 15.9994 # OW\n2 1.008", "1 16\n2 1"), "w").spheres.attributes().element.empty());
  EXPECT_TRUE(
      read_text(with("timestep = 4000", "timestep = 4000, units = lj"), "w").spheres.attributes().element.empty());
}

TEST(LammpsData, TellsAStyleByItsColumns) {
  const auto atoms = [](const std::string& line) {
    return "x\n\n1 atoms\n3 atom types\n\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms\n\n" + line + "\n";
  };
  EXPECT_TRUE(has_rule(read_text(atoms("1 2 3 4 5"), "a"), "atom style: atomic, by the number of columns"));
  EXPECT_TRUE(has_rule(read_text(atoms("1 2 3 4 5 0 0 0"), "a"), "(id type x y z ix iy iz)"));
  EXPECT_TRUE(has_rule(read_text(atoms("1 9 2 3.0 4 5"), "a"), "atom style: molecular"));
  EXPECT_TRUE(has_rule(read_text(atoms("1 2 -0.5 3.0 4 5"), "a"), "atom style: charge"));
  EXPECT_TRUE(has_rule(read_text(atoms("1 9 2 0.5 3.0 4 5"), "a"), "atom style: full"));
  const SphereFile grains = read_text(atoms("1 2 0.5 2600 3.0 4 5"), "a");
  EXPECT_TRUE(has_rule(grains, "atom style: sphere"));
  EXPECT_EQ(grains.spheres.radius(0), 0.25);
  EXPECT_NE(error_of(atoms("1 2 0.5 3.0 4 5 0.1 0.2 0.3"), "a").find("Atoms # full"), std::string::npos);
  std::string shapes = atoms("1 2 1 0.5 3.0 4 5");
  shapes.replace(shapes.find("3 atom types"), 12, "3 atom types\n1 ellipsoids");
  EXPECT_TRUE(
      has_rule(read_text(shapes, "a"), "atom style: ellipsoid, by the header (id type ellipsoidflag density x y z)"));
  // Stated styles of every width.
  const auto stated = [&](const std::string& style, const std::string& line) {
    std::string text = atoms(line);
    return text.replace(text.find("Atoms\n"), 6, "Atoms # " + style + "\n");
  };
  EXPECT_EQ(numbers_of(read_text(stated("dipole", "1 2 0.5 3 4 5 0.1 0.2 0.3"), "a"), "muz")[0], 0.3);
  const SphereFile hybrid = read_text(stated("hybrid sphere dipole", "1 2 3 4 5 0.5 7 0.1 0.2 0.3 0.4"), "a");
  EXPECT_EQ(hybrid.spheres.radius(0), 0.25);
  EXPECT_EQ(numbers_of(hybrid, "q")[0], 0.1);
  EXPECT_EQ(hybrid.spheres.centre(0), (Vec3d{3, 4, 5}));
  // What every hybrid style has, where its parts are unknown.
  const SphereFile open = read_text(stated("hybrid other", "1 2 3 4 5 0.5 7"), "a");
  EXPECT_EQ(open.spheres.centre(0), (Vec3d{3, 4, 5}));
  EXPECT_TRUE(has_rule(open, "(id type x y z, others are left out)"));
}

std::string atoms_of(const std::string& style, const std::string& lines) {
  const auto count = std::count(lines.begin(), lines.end(), '\n');
  return "x\n\n" + std::to_string(count) + " atoms\n3 atom types\n\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms" +
         (style.empty() ? "" : " # " + style) + "\n\n" + lines;
}

// A line of each style of the manual: x, y and z are 5, 6 and 7, a diameter is 8.
TEST(LammpsData, KnowsTheStylesOfTheManual) {
  constexpr std::pair<const char*, const char*> kLines[] = {
      {"amoeba", "1 9 2 0.5 5 6 7"},
      {"angle", "1 9 2 5 6 7"},
      {"apip", "1 2 5 6 7"},
      {"atomic", "1 2 5 6 7"},
      {"body", "1 2 1 0.5 5 6 7"},
      {"bond", "1 9 2 5 6 7"},
      {"bpm/sphere", "1 9 2 8 0.5 5 6 7"},
      {"charge", "1 2 0.5 5 6 7"},
      {"dielectric", "1 2 0.5 5 6 7 0 0 1 1.5 2.5 3.5 4.5 5.5"},
      {"dielectric", "1 9 2 0.5 5 6 7 0 0 1 1.5 2.5 3.5 4.5 5.5"},
      {"dipole", "1 2 0.5 5 6 7 0.1 0.2 0.3"},
      {"dpd", "1 2 0.5 5 6 7"},
      {"edpd", "1 2 0.5 0.6 5 6 7"},
      {"electron", "1 2 0.5 1 0.6 5 6 7"},
      {"ellipsoid", "1 2 1 0.5 5 6 7"},
      {"full", "1 9 2 0.5 5 6 7"},
      {"full/kk", "1 9 2 0.5 5 6 7"},
      {"line", "1 9 2 1 0.5 5 6 7"},
      {"mdpd", "1 2 0.5 5 6 7"},
      {"mesont", "1 9 2 3 0.5 0.5 0.5 0 5 6 7"},
      {"mesont", "1 9 2 3 4 0.5 0.5 0.5 0 5 6 7"},
      {"molecular", "1 9 2 5 6 7"},
      {"oxdna", "1 2 5 6 7"},
      {"peri", "1 2 0.5 0.6 5 6 7"},
      {"rheo", "1 2 0 0.5 5 6 7"},
      {"rheo/thermal", "1 2 0 0.5 0.6 5 6 7"},
      {"smd", "1 2 9 0.5 0.5 0.5 0.5 1 2 3 5 6 7"},
      {"sph", "1 2 0.5 0.5 0.5 5 6 7"},
      {"sphere", "1 2 8 0.5 5 6 7"},
      {"spin", "1 2 5 6 7 0.1 0.2 0.3 1"},
      {"tdpd", "1 2 5 6 7"},
      {"tdpd 2", "1 2 5 6 7 0.1 0.2"},
      {"template", "1 2 9 1 1 5 6 7"},
      {"tri", "1 9 2 1 0.5 5 6 7"},
      {"wavepacket", "1 2 0.5 1 0.6 1 0.7 0.8 5 6 7"},
  };
  for (const auto& [style, line] : kLines)
    for (const char* const flags : {"\n", " 1 0 -1\n"}) {
      const SphereFile file = read_text(atoms_of(style, line + std::string(flags)), "a.data");
      ASSERT_EQ(file.spheres.size(), 1) << style;
      EXPECT_EQ(file.spheres.centre(0), (Vec3d{5, 6, 7})) << style;
      EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{2})) << style << " " << flags;
      EXPECT_EQ(has_rule(file, "diameter"), std::string(style).find("sphere") != std::string::npos) << style;
      EXPECT_EQ(numbers_of(file, "iz"), flags[0] == ' ' ? std::vector<double>{-1} : std::vector<double>{}) << style;
    }
  EXPECT_EQ(numbers_of(read_text(atoms_of("tdpd", "1 2 5 6 7 0.1 0.2 0 0 1\n"), "a"), "cc2")[0], 0.2);
  EXPECT_EQ(numbers_of(read_text(atoms_of("dielectric", "1 9 2 0.5 5 6 7 0 0 1 1.5 2.5 3.5 4.5 5.5\n"), "a"), "mol")[0],
            9);
}

TEST(LammpsData, RefusesStylesThatItDoesNotKnow) {
  const std::string message = error_of(atoms_of("granular", "1 2 5 6 7 0.1 0.2\n"), "a");
  EXPECT_EQ(
      message.rfind("a:12: the atom style 'granular' behind 'Atoms' (line 10) is not known; known are amoeba, ", 0), 0u)
      << message;
}

// The first line alone would be molecular, full, or have image flags.
TEST(LammpsData, TellsAStyleByAllLines) {
  EXPECT_TRUE(has_rule(read_text(atoms_of("", "1 2 1 3.5 4 5\n2 1 -1 3 4 5\n"), "a"), "atom style: charge"));
  EXPECT_TRUE(has_rule(read_text(atoms_of("", "1 2 1 2 3 4 5\n2 1 0.5 2 3 4 5\n"), "a"), "atom style: sphere"));
  const SphereFile file = read_text(atoms_of("tdpd", "1 2 5 6 7 1 2 3\n2 2 5 6 7 0.5 2 3\n"), "a");
  EXPECT_EQ(numbers_of(file, "cc1"), (std::vector<double>{1, 0.5}));
  EXPECT_TRUE(numbers_of(file, "ix").empty());
}

// Labels number the types, and masses by labels tell elements.
TEST(LammpsData, LabelsHaveTypesAndElements) {
  const std::string head = "x\n\n3 atoms\n2 atom types\n\n";
  const std::string labels = "Atom Type Labels\n\n2 C\n1 ow\n\n";
  const std::string atoms = "Atoms # atomic\n\n1 C 1 2 3\n2 ow 4 5 6\n3 1 7 8 9\n\n";
  const std::string masses = "Masses\n\nC 12.011\n1 15.9994\n";
  const SphereFile file = read_text(head + labels + masses + "\n" + atoms, "a.data");
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{2, 1, 1}));
  EXPECT_EQ(file.spheres.attributes().find_texts("type")->of(2), "ow");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 8, 8}));
  // Labels that another file numbers.
  const std::string own = "Atoms # atomic\n\n1 C 1 2 3\n2 ow 4 5 6\n3 ow 7 8 9\n\n";
  const SphereFile unnumbered = read_text(head + own + "Masses\n\nC 12.011\now 15.9994\n", "a.data");
  EXPECT_EQ(unnumbered.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 2}));
  EXPECT_EQ(unnumbered.spheres.attributes().element, (std::vector<std::uint8_t>{6, 8, 8}));
  // Types by number get the labels as well.
  std::string numbers = head + labels + masses + "\n" + atoms;
  numbers.replace(numbers.find("1 C 1"), 5, "1 2 1");
  numbers.replace(numbers.find("2 ow 4"), 6, "2 1 4");
  EXPECT_EQ(read_text(numbers, "a.data").spheres.attributes().find_texts("type")->of(0), "C");
  EXPECT_NE(error_of(head + labels + own.substr(0, own.find("3 ow")) + "3 hw 7 8 9\n", "a").find("the type 'hw' is no"),
            std::string::npos);
}

TEST(LammpsData, TakesTypeLabels) {
  std::string text = with("Masses\n", "Atom Type Labels\n\n1 OW\n2 HW\n\nMasses\n");
  text.replace(text.find("1 7 1 -0.8"), 10, "1 7 OW -0.8");
  text.replace(text.find("2 7 2 0.4"), 9, "2 7 HW 0.4");
  text.replace(text.find("3 7 2 0.4"), 9, "3 7 HW 0.4");
  const SphereFile file = read_text(text, "w.data");
  ASSERT_NE(file.spheres.attributes().find_texts("type"), nullptr);
  EXPECT_EQ(file.spheres.attributes().find_texts("type")->of(2), "HW");
}

TEST(LammpsData, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with("1.5 2.5 3.5", "1.5 x.5 3.5"), "w"), "w:24:15: expected a number for y but found 'x.5'");
  EXPECT_EQ(error_of(with("1.5 2.5 3.5", "1.5 nan 3.5"), "w"), "w:24:15: y is not finite: 'nan'");
  EXPECT_EQ(error_of(with("3 atoms", "4 atoms"), "w").rfind("w:27: expected 4 atoms but found 3", 0), 0u);
  EXPECT_EQ(error_of(with("3 atoms", "2 atoms"), "w").rfind("w:25: expected the name of a section", 0), 0u);
  EXPECT_EQ(error_of(with("3 atoms", "-3 atoms"), "w"), "w:3:1: expected the number of atoms but found '-3'");
  EXPECT_EQ(error_of(with("2 bonds", "3 atoms"), "w"), "w:5: the number of atoms comes twice");
  EXPECT_EQ(error_of(with("-1.5 8.5 xlo", "-1.5 xlo"), "w").rfind("w:7: expected 2 numbers before 'xlo xhi'", 0), 0u);
  EXPECT_EQ(error_of(with("2 1.008", "2 heavy"), "w").rfind("w:15:3: expected the mass of type '2'", 0), 0u);
  EXPECT_EQ(error_of(with("Bonds\n", "Masses\n"), "w"), "w:33: the section 'Masses' comes twice");
  EXPECT_EQ(error_of("x\n\n3 atoms\n", "w"), "w:3: the file ends without the section 'Atoms'");
  EXPECT_EQ(error_of("x\n\n1 atoms\n\nAtoms # atomic\n\n", "w"),
            "w:6: the file ends in its atoms: expected 1, found 0");
  EXPECT_EQ(error_of("x\n\n9000000000000000000 atoms\n\nAtoms # atomic\n\n1 1 0 0 0\n", "w"),
            "w:7: the file ends in its atoms: expected 9000000000000000000, found 1");
  EXPECT_NE(error_of(kWater, "w", at_frame(1)).find("there is no frame 1"), std::string::npos);
  EXPECT_NE(error_of("x\n\n0 atoms\n\nAtoms\n\n", "w").find("there are no spheres"), std::string::npos);
  // A file cut anywhere gives an answer or an error.
  for (std::size_t length = 0; length < kWater.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(kWater).substr(0, length), "w", {});
}

}  // namespace
}  // namespace bihive
