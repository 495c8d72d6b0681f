#include <gtest/gtest.h>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::read_text;
using test::with;

const std::string kDiamond =
    "cubic diamond\n"
    "  2.0\n"
    "1.0 0.0 0.0\n"
    "0.5 1.5 0.0\n"
    "0.0 0.0 2.0\n"
    "C Si_pv\n"
    "1 2 ! counts\n"
    "Selective dynamics\n"
    "Direct\n"
    "0.0 0.0 0.0 T T F\n"
    "0.5 0.5 0.25 T T T Si\n"
    "1.25 0.0 -0.5\n"
    "\n"
    "0 0 0\n";

const std::string kRun =
    "run\n1\n5 0 0\n0 5 0\n0 0 5\nC X\n1 1\n"
    "Direct configuration=     1\n0 0 0\n0.5 0.5 0.5\n"
    "Direct configuration=    10\n0.1 0 0\n0.5 0.5 0.5\n"
    "run\n1\n6 0 0\n0 6 0\n0 0 6\nC X\n1 1\n"
    "Direct configuration=    20\n0.5 0 0\n0.5 0.5 0.5\n\n";

TEST(Poscar, TakesDirectPlacesAndTheCell) {
  const SphereFile file = read_text(kDiamond, "POSCAR");
  EXPECT_EQ(file.format, "POSCAR");
  ASSERT_EQ(file.spheres.size(), 3);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{1.5, 1.5, 1}));
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{2.5, 0, -2})) << "places outside of the cell stay there";
  EXPECT_EQ(file.spheres.cell()->vectors, (std::array<Vec3d, 3>{Vec3d{2, 0, 0}, Vec3d{1, 3, 0}, Vec3d{0, 0, 4}}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 14, 14}));
  EXPECT_TRUE(file.spheres.attributes().type.empty());
}

TEST(Poscar, TakesCartesianPlacesVolumesAndThreeFactors) {
  const std::string cartesian = with(kDiamond, "Direct", "Kartesian");
  EXPECT_EQ(read_text(cartesian, "POSCAR").spheres.centre(1), (Vec3d{1, 1, 0.5}));
  // The volume of the vectors is 3; that of the cell is to be 24: a factor of 2.
  const SphereFile volume = read_text(with(kDiamond, "  2.0\n", "-24\n"), "POSCAR");
  EXPECT_EQ(volume.spheres.cell()->vectors[1], (Vec3d{1, 3, 0}));
  const SphereFile three = read_text(with(cartesian, "  2.0\n", "1 2 3\n"), "POSCAR");
  EXPECT_EQ(three.spheres.cell()->vectors[1], (Vec3d{0.5, 3, 0}));
  EXPECT_EQ(three.spheres.centre(1), (Vec3d{0.5, 1, 0.75}));
}

TEST(Poscar, TakesOldFilesWithoutNames) {
  const std::string old = with(with(kDiamond, "C Si_pv\n", ""), "Selective dynamics\n", "");
  const SphereFile types = read_text(old, "POSCAR");
  EXPECT_TRUE(types.spheres.attributes().element.empty());
  EXPECT_EQ(types.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 2}));
  const SphereFile named = read_text(with(old, "cubic diamond", " C Si"), "POSCAR");
  EXPECT_EQ(named.spheres.attributes().element, (std::vector<std::uint8_t>{6, 14, 14}));
}

TEST(Poscar, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with(kDiamond, "0.5 0.5 0.25", "0.5 0.5 nan"), "P"), "P:11:9: z is not finite: 'nan'");
  EXPECT_EQ(error_of(with(kDiamond, "0.5 0.5 0.25", "0.5 0,5 0.25"), "P"),
            "P:11:5: expected a number for y but found '0,5'");
  EXPECT_EQ(error_of(with(kDiamond, "1.25 0.0 -0.5\n\n0 0 0\n", ""), "P"),
            "P:11: the file ends too early: expected 3 atoms (line 7) but found 2");
  EXPECT_EQ(error_of(with(kDiamond, "1 2 !", "1 9000000000000000000 !"), "P").rfind("P:7:3: there are more than", 0),
            0u);
  EXPECT_EQ(error_of(with(kDiamond, "1 2 !", "1 1000000000000 !"), "P").rfind("P:13:", 0), 0u);
  EXPECT_EQ(error_of(with(kDiamond, "1 2 !", "1 2 3"), "P").rfind("P:7:5: expected a count for each of 2 names", 0),
            0u);
  EXPECT_EQ(error_of(with(kDiamond, "1 2 !", "1 -2 !"), "P").rfind("P:7:3: expected the number of atoms of", 0), 0u);
  EXPECT_EQ(error_of(with(kDiamond, "  2.0\n", "0\n"), "P").rfind("P:2: the factor must be positive", 0), 0u);
  EXPECT_EQ(error_of(with(kDiamond, "\nDirect", "\nSpherical"), "POSCAR").rfind("POSCAR:9: expected 'Direct'", 0), 0u);
  EXPECT_NE(error_of(kDiamond, "P", at_frame(1)).find("there is no frame 1"), std::string::npos);
  for (std::size_t length = 0; length < kDiamond.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(kDiamond).substr(0, length), "POSCAR", {});
}

// A comment where names or counts should stand: the look at the first lines goes on without words.
TEST(Poscar, ACommentInPlaceOfNamesIsNoStructure) {
  for (const char* const comment : {"# c\n", "! c\n# d\n"}) {
    const std::string text = std::string("x\n1\n1 0 0\n0 1 0\n0 0 1\n") + comment;
    EXPECT_NE(error_of(text, "a").find("no file of spheres in a known format"), std::string::npos);
    EXPECT_EQ(error_of(text, "POSCAR").find("known format"), std::string::npos);
  }
}

TEST(Xdatcar, TakesEveryFrame) {
  const SphereFile first = read_text(kRun, "x");
  EXPECT_EQ(first.format, "XDATCAR");
  EXPECT_EQ(first.frames, 3);
  EXPECT_EQ(*first.step, 1);
  EXPECT_EQ(first.spheres.attributes().element, (std::vector<std::uint8_t>{6, 0}));
  const SphereFile second = read_text(kRun, "x", at_frame(1));
  EXPECT_EQ(second.spheres.centre(0), (Vec3d{0.5, 0, 0}));
  EXPECT_EQ(*second.step, 10);
  const SphereFile third = read_text(kRun, "x", at_frame(2));
  EXPECT_EQ(third.spheres.centre(0), (Vec3d{3, 0, 0}));
  EXPECT_EQ(third.spheres.cell()->vectors[2], (Vec3d{0, 0, 6}));
  EXPECT_NE(error_of(kRun, "x", at_frame(3)).find("the file has 3 (0 to 2)"), std::string::npos);
}

TEST(Xdatcar, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(kRun.substr(0, kRun.find("0.5 0.5 0.5\nrun")), "x"),
            "x:12: the file ends too early: expected 2 atoms (line 7) but found 1");
  EXPECT_EQ(error_of(with(kRun, "Direct configuration=    20", "Direct"), "x").rfind("x:21: expected 'Direct conf", 0),
            0u);
  for (std::size_t length = 0; length < kRun.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(kRun).substr(0, length), "XDATCAR", {});
}

}  // namespace
}  // namespace bihive
