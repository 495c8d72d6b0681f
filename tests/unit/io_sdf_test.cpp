// SDF, MOL and MOL2.
#include <gtest/gtest.h>

#include <cmath>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;
using test::with;

const std::string kTwoMolecules =
    "acetate\n"
    "  program\n"
    "\n"
    "  3  2  0  0  0  0  0  0  0  0999 V2000\n"
    "    1.0000    2.0000   -3.5000 C   0  0  0  0  0\n"
    "    0.0000    0.2500    0.0000 O   0  5  0  0  0\n"
    "  -10.5000    0.0000    0.0000 Cl  0  0  0  0  0\n"
    "  1  2  2  0\n"
    "  1  3  1  0\n"
    "M  END\n"
    "> <ID>\n"
    "17\n"
    "\n"
    "$$$$\n"
    "\n"
    "  program\n"
    "\n"
    "  0  0  0     0  0            999 V3000\n"
    "M  V30 BEGIN CTAB\n"
    "M  V30 COUNTS 2 1 0 0 0\n"
    "M  V30 BEGIN ATOM\n"
    "M  V30 1 N 1.5 2.5 3.5 0 -\n"
    "M  V30 CHG=1\n"
    "M  V30 2 \"NOT [N, O]\" 4 5 6 0 CHG=-1 CFG=1\n"
    "M  V30 END ATOM\n"
    "M  V30 BEGIN BOND\n"
    "M  V30 1 1 1 2\n"
    "M  V30 END BOND\n"
    "M  V30 END CTAB\n"
    "M  END\n"
    "$$$$\n";

const std::string kMol2 =
    "# a comment\n"
    "@<TRIPOS>MOLECULE\n"
    "ligand\n"
    " 4 1 1\n"
    "SMALL\n"
    "USER_CHARGES\n"
    "\n"
    "@<TRIPOS>ATOM\n"
    "      1 C1          1.0000   2.0000   3.0000 C.ar    1  LIG1        0.1250\n"
    "      2 CL2         1.5000   2.0000   3.0000 cl      1  LIG1       -0.2500\n"
    "      3 X1          0.0000   0.0000   0.0000 Du      1  LIG1        0.0000\n"
    "      4 HA          0.0000   0.0000   1.0000 CA      2  ALA2        0.0000\n"
    "@<TRIPOS>BOND\n"
    "     1    1    2   1\n"
    "@<TRIPOS>CRYSIN\n"
    "   10.0 20.0 30.0 90.0 90.0 90.0 1 1\n"
    "@<TRIPOS>MOLECULE\n"
    "two\n"
    " 1\n"
    "@<TRIPOS>ATOM\n"
    "1 O 7 8 9 O.3\n";

TEST(Sdf, TakesFixedColumns) {
  const SphereFile file = read_text(kTwoMolecules, "a.sdf");
  EXPECT_EQ(file.format, "SDF");
  EXPECT_EQ(file.frames, 2);
  ASSERT_EQ(file.spheres.size(), 3);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, -3.5}));
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{-10.5, 0, 0}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 8, 17}));
  EXPECT_EQ(numbers_of(file, "charge"), (std::vector<double>{0, -1, 0}));
  // Charges of their own line count alone.
  const SphereFile charged = read_text(with(kTwoMolecules, "M  END", "M  CHG  1   3   2\nM  END"), "a.sdf");
  EXPECT_EQ(numbers_of(charged, "charge"), (std::vector<double>{0, 0, 2}));
}

TEST(Sdf, TakesVersion3000) {
  const SphereFile file = read_text(kTwoMolecules, "a.sdf", at_frame(1));
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1.5, 2.5, 3.5}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{7, 0}));
  EXPECT_EQ(numbers_of(file, "charge"), (std::vector<double>{1, -1}));
  EXPECT_NE(error_of(kTwoMolecules, "a.sdf", at_frame(2)).find("there is no frame 2"), std::string::npos);

  // One blank where the format has two.
  std::string narrow = kTwoMolecules;
  for (std::size_t at = 0; (at = narrow.find("M  V30", at)) != std::string::npos;) narrow.replace(at, 6, "M V30");
  const SphereFile same = read_text(narrow, "a.sdf", at_frame(1));
  ASSERT_EQ(same.spheres.size(), 2);
  EXPECT_EQ(same.spheres.centre(1), file.spheres.centre(1));
  EXPECT_EQ(numbers_of(same, "charge"), numbers_of(file, "charge"));
}

TEST(Sdf, SaysWhereItIsWrong) {
  EXPECT_EQ(
      error_of(with(kTwoMolecules, "   -3.5000 C", "   -3.5x00 C"), "a").rfind("a:5:21: expected a number for z", 0),
      0u);
  EXPECT_EQ(error_of(with(kTwoMolecules, "   -3.5000 C", "       nan C"), "a"), "a:5:21: z is not finite: 'nan'");
  EXPECT_EQ(
      error_of(with(kTwoMolecules, "  3  2  0", " -3  2  0"), "a").rfind("a:4:1: expected the numbers of atoms", 0),
      0u);
  EXPECT_EQ(error_of(with(kTwoMolecules, "  3  2  0", "999  2  0"), "a").rfind("a:8:1: expected a number for x", 0),
            0u);
  EXPECT_EQ(error_of(with(kTwoMolecules, "M  END", "M  CHG  1   4   2\nM  END"), "a"),
            "a:10: there is no atom 4 in the molecule");
  EXPECT_EQ(error_of(with(kTwoMolecules, "COUNTS 2", "COUNTS 3"), "a").rfind("a:30: the molecule ends too early", 0),
            0u);
  EXPECT_EQ(
      error_of(with(kTwoMolecules, "M  V30 COUNTS 2 1 0 0 0\n", ""), "a").rfind("a:21: expected 'M  V30 COUNTS'", 0),
      0u);
  EXPECT_EQ(error_of(with(kTwoMolecules, "COUNTS 2", "COUNTS 1"), "a").rfind("a:24: there are more atoms", 0), 0u);
  EXPECT_EQ(
      error_of(with(kTwoMolecules, "BEGIN BOND", "BEGIN ATOM"), "a").rfind("a:26: the block of atoms comes twice", 0),
      0u);
  for (std::size_t length = 0; length < kTwoMolecules.size(); ++length)
    for (const int frame : {0, 1})
      (void)read_spheres_from_memory(std::string_view(kTwoMolecules).substr(0, length), "a.sdf", at_frame(frame));
}

TEST(Mol2, TakesAtomsChargesAndTheCell) {
  const SphereFile file = read_text(kMol2, "a.mol2");
  EXPECT_EQ(file.format, "MOL2");
  EXPECT_EQ(file.frames, 2);
  ASSERT_EQ(file.spheres.size(), 4);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{1.5, 2, 3}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 17, 0, 1}))
      << "a type that tells nothing leaves it to the name";
  EXPECT_EQ(numbers_of(file, "charge"), (std::vector<double>{0.125, -0.25, 0, 0}));
  EXPECT_EQ(numbers_of(file, "resid"), (std::vector<double>{1, 1, 1, 2}));
  EXPECT_EQ(file.spheres.attributes().find_texts("name")->of(1), "CL2");
  EXPECT_EQ(file.spheres.attributes().find_texts("resname")->of(3), "ALA2");
  EXPECT_EQ(file.spheres.attributes().find_texts("type")->of(0), "C.ar");
  EXPECT_EQ(file.spheres.cell()->vectors[1], (Vec3d{0, 20, 0}));
  const SphereFile second = read_text(kMol2, "a.mol2", at_frame(1));
  EXPECT_EQ(second.spheres.centre(0), (Vec3d{7, 8, 9}));
  EXPECT_FALSE(second.spheres.cell().has_value());
  EXPECT_TRUE(numbers_of(second, "charge").empty());
}

TEST(Mol2, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with(kMol2, "1.5000", "1.x000"), "a").rfind("a:10:21: expected a number for x", 0), 0u);
  EXPECT_EQ(error_of(with(kMol2, "1.5000", "   inf"), "a").rfind("a:10:24: x is not finite", 0), 0u);
  EXPECT_EQ(error_of(with(kMol2, " 4 1 1", " 5 1 1"), "a").rfind("a:13: expected 5 atoms", 0), 0u);
  EXPECT_EQ(error_of(with(kMol2, " 4 1 1", " x 1 1"), "a").rfind("a:4:2: expected the number of atoms", 0), 0u);
  EXPECT_EQ(error_of(with(kMol2, "@<TRIPOS>BOND", "@<TRIPOS>ATOM"), "a").rfind("a:13: the section ATOM comes twice", 0),
            0u);
  EXPECT_EQ(
      error_of(with(kMol2, "@<TRIPOS>MOLECULE\nligand", "ligand"), "a").rfind("a:7: expected @<TRIPOS>MOLECULE", 0),
      0u);
  EXPECT_EQ(
      error_of("@<TRIPOS>MOLECULE\nx\n900000000000000\n@<TRIPOS>ATOM\n1 C 0 0 0 C\n", "a").rfind("a:5: expected 9", 0),
      0u);
  for (std::size_t length = 0; length < kMol2.size(); ++length)
    for (const int frame : {0, 1})
      (void)read_spheres_from_memory(std::string_view(kMol2).substr(0, length), "a.mol2", at_frame(frame));
}

TEST(Sdf, LinesOfVersion3000MayGoOnAnywhere) {
  const std::string cut = with(with(kTwoMolecules, "M  V30 2 \"NOT [N, O]\" 4 5 6 0",
                                    "M  V30 2 \"NOT [N, -\nM  V30 O]\" -\nM V30 4 5.-\nM  V30 0 6 0"),
                               "M  V30 COUNTS 2 1", "M  V30 COUNTS -\nM  V30 2 1");
  const SphereFile file = read_text(cut, "a.sdf", at_frame(1));
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(numbers_of(file, "charge"), (std::vector<double>{1, -1}));
  // Lines keep their numbers, and other lines that end in a hyphen are no such lines.
  EXPECT_EQ(error_of(with(cut, "BEGIN BOND", "BEGIN ATOM"), "a").rfind("a:30: the block of atoms comes twice", 0), 0u);
  EXPECT_EQ(read_text(with(kTwoMolecules, "acetate\n", "acetate -\n"), "a.sdf").spheres.size(), 3);
  for (std::size_t length = 0; length < cut.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(cut).substr(0, length), "a.sdf", at_frame(1));
}

TEST(Sdf, TheEndingTellsWhereTheVersionIsMissing) {
  const std::string old =
      "2244\n  own\n\n  2  0  0  0  0  0              1\n    1.0000    2.0000    3.0000 C   0  0\n"
      "    4.0000    5.0000    6.0000 O   0  0\nM  END\n$$$$\n";
  for (const char* name : {"a.sdf", "a.mol", "a.sd.gz"}) {
    const SphereFile file = read_text(old, name);
    EXPECT_EQ(file.format, "SDF");
    ASSERT_EQ(file.spheres.size(), 2);
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  }
}

TEST(Mol2, LinesMayGoOn) {
  const SphereFile file =
      read_text(with(kMol2, "1.5000   2.0000   3.0000 cl", "1.5000 \\\n   2.0000   3.0000\\\n cl"), "a.mol2");
  ASSERT_EQ(file.spheres.size(), 4);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{1.5, 2, 3}));
  EXPECT_EQ(file.spheres.attributes().find_texts("type")->of(1), "cl");
}

}  // namespace
}  // namespace bihive
