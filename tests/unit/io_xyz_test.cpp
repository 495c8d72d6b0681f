#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::number_names;
using test::numbers_of;
using test::read_text;

TEST(Xyz, TakesSymbolsAndNumbersOfElements) {
  const SphereFile file = read_text("3\nwater\nO 0 0 0.5\n h  1 0 0 0.1 extra\n8 -1 0 0\n", "w.xyz");
  EXPECT_EQ(file.format, "XYZ");
  ASSERT_EQ(file.spheres.size(), 3);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{0, 0, 0.5}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{8, 1, 8}));
  EXPECT_TRUE(file.spheres.attributes().type.empty());
  EXPECT_FLOAT_EQ(static_cast<float>(file.spheres.radius(0)), 1.52f) << "van der Waals radius of oxygen";
  EXPECT_FLOAT_EQ(static_cast<float>(file.spheres.radius(1)), 1.2f);
  EXPECT_TRUE(file.warnings.empty());
}

TEST(Xyz, TakesOtherLabelsAsTypes) {
  const SphereFile file = read_text("3\n\nbead 0 0 0\nC 1 0 0\nbead 2 0 0\n", "a.xyz");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{0, 6, 0}));
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 1}));
  EXPECT_EQ(file.spheres.radius(0), 0.5);
  EXPECT_FLOAT_EQ(static_cast<float>(file.spheres.radius(1)), 1.7f);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0],
            "2 spheres have neither element nor radius; each gets radius 0.5, half the middle distance to the nearest "
            "neighbour; radius sets another");

  const SphereFile numbers = read_text("2\n\n0 0 0 0\n500 1 0 0\n", "a.xyz");
  EXPECT_EQ(numbers.spheres.attributes().type, (std::vector<std::int32_t>{0, 500}));
  EXPECT_TRUE(numbers.spheres.attributes().element.empty());
}

TEST(Xyz, TakesTheFrameAskedFor) {
  const std::string text = "1\nfirst\nC 1 0 0\n2\nsecond\nN 2 0 0\nN 3 0 0\n\n\n1\nthird\nO 4 0 0\n\n";
  for (const auto& [frame, size, x] : {std::tuple{0, 1, 1.0}, {1, 2, 2.0}, {2, 1, 4.0}}) {
    const SphereFile file = read_text(text, "a.xyz", at_frame(frame));
    EXPECT_EQ(file.frames, 3);
    EXPECT_EQ(file.spheres.size(), size);
    EXPECT_EQ(file.spheres.centre(0).x, x);
  }
  EXPECT_EQ(error_of(text, "a.xyz", at_frame(3)),
            "a.xyz: there is no frame 3: the file has 3 (0 to 2); choose one with frame, counting from 0");
  // Negative numbers count from the end.
  EXPECT_EQ(read_text(text, "a.xyz", at_frame(-1)).spheres.centre(0).x, 4);
  EXPECT_EQ(read_text(text, "a.xyz", at_frame(-3)).spheres.centre(0).x, 1);
  EXPECT_EQ(error_of(text, "a.xyz", at_frame(-4)),
            "a.xyz: there is no frame -4: the file has 3 (0 to 2); choose one with frame, counting from 0");
}

TEST(Xyz, ReadsExtendedColumns) {
  const SphereFile file = read_text(
      "2\n"
      "Lattice=\"1 0 0 0 1 0 0 0 1\" Properties=id:I:1:species:S:1:pos:R:3:Radius:R:1:forces:R:3:name:S:1:fixed:L:1:"
      "color:R:3:transparency:R:1:x:R:1 pbc=\"T T T\"\n"
      "11 Cu 1 2 3 0.75 0.1 0.2 0.3 left T 1 0 0.25 0.25 7\n"
      "12 H  4 5 6 0.25 0.4 0.5 0.6 right F 0 1 0 0 8\n",
      "a.xyz");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file.spheres.radius(0), 0.75);
  const SphereAttributes& attributes = file.spheres.attributes();
  EXPECT_EQ(attributes.element, (std::vector<std::uint8_t>{29, 1}));
  EXPECT_EQ(attributes.colour[0], (Vec3f{1, 0, 0.25f}));
  EXPECT_EQ(attributes.opacity, (std::vector<float>{0.75f, 1}));
  EXPECT_EQ(number_names(file), (std::vector<std::string>{"id", "forces_1", "forces_2", "forces_3", "x"}));
  EXPECT_EQ(numbers_of(file, "forces_2"), (std::vector<double>{0.2, 0.5}));
  EXPECT_EQ(numbers_of(file, "x"), (std::vector<double>{7, 8}));
}

TEST(Xyz, ReadsExtendedAtomicNumbersAndQuotedProperties) {
  const SphereFile file = read_text("1\nproperties='Z:I:1:pos:R:3'\n26 1 2 3\n", "a.xyz");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{26}));
  EXPECT_EQ(read_text("1\nmyProperties=none\nC 1 2 3\n", "a.xyz").spheres.size(), 1);
  EXPECT_EQ(error_of("1\nProperties=Z:I:1:pos:R:3\n119 1 2 3\n", "a.xyz"),
            "a.xyz:3:1: Z is not one of 0 to 118: '119'");
}

// Every form that the specification allows, and the older ones.
TEST(Xyz, ReadsEveryFormOfTheComment) {
  const std::string rows = "O 0.1 0.2 0.3 1 2 3\nH 0.4 0.5 0.6 4 5 6\n";
  for (
      const char* const comment : {
          R"(Lattice="5 0 0 1 6 0 0 0 7" Properties=species:S:1:forces:R:3:pos:R:3)",
          R"(Lattice = "5 0 0 1 6 0 0 0 7" Properties = species:S:1:forces:R:3:pos:R:3)",
          R"("Lattice"="5 0 0 1 6 0 0 0 7" "Properties" = "species:S:1:forces:R:3:pos:R:3")",
          R"(title="relaxed lattice=fcc properties=x run" Lattice="5 0 0 1 6 0 0 0 7" Properties=species:S:1:forces:R:3:pos:R:3)",
          R"(title="say \"lattice=1\"" LATTICE='5 0 0 1 6 0 0 0 7' PROPERTIES=species:S:1:forces:R:3:pos:R:3)",
          R"(Lattice={5 0 0 1 6 0 0 0 7} Properties=species:S:1:forces:R:3:pos:R:3)",
          R"(Lattice=[[5, 0, 0], [1, 6, 0], [0, 0, 7]] Properties=species:S:1:forces:R:3:pos:R:3)",
          R"(Lattice=[5,0,0,1,6,0,0,0,7], Properties=species:S:1:forces:R:3:pos:R:3)",
          R"(stress=[[1, 2], ["lattice=3", 4]] Lattice="5.0D0 0 0 1 6 0 0 0 7" Properties=species:S:1:forces:R:3:pos:R:3 note="open)",
      }) {
    const SphereFile file = read_text("2\n" + std::string(comment) + "\n" + rows, "a.xyz");
    ASSERT_EQ(file.spheres.size(), 2) << comment;
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6})) << comment;
    ASSERT_TRUE(file.spheres.cell().has_value()) << comment;
    EXPECT_EQ(file.spheres.cell()->vectors, (std::array<Vec3d, 3>{Vec3d{5, 0, 0}, Vec3d{1, 6, 0}, Vec3d{0, 0, 7}}))
        << comment;
  }
  const SphereFile moved = read_text("1\nOrigin=[1, 2, 3] Lattice=\"5 0 0 0 6 0 0 0 7\"\nC 1 2 3\n", "a.xyz");
  EXPECT_EQ(moved.spheres.cell()->origin, (Vec3d{1, 2, 3}));
  // A comment may be anything else.
  for (const char* const comment : {"it's = a \"test", "=", "= =", "'", "a=", "{[\"", "i = 5, E = -1.2", "\\", "\"\\"})
    EXPECT_EQ(read_text("1\n" + std::string(comment) + "\nC 1 2 3\n", "a.xyz").spheres.size(), 1) << comment;
}

TEST(Xyz, RefusesACommentThatItDoesNotUnderstand) {
  EXPECT_EQ(
      error_of("1\ntitle=\"a b Lattice=\"5 0 0 0 6 0 0 0 7\" Properties=species:S:1:pos:R:3\nC 1 2 3\n", "a.xyz"),
      "a.xyz:2:21: from here on the comment of extended XYZ is not understood; is a quote or bracket not closed?");
  EXPECT_EQ(
      error_of("1\nProperties=\"species:S:1:pos:R:3\nC 1 2 3\n", "a.xyz"),
      "a.xyz:2:12: from here on the comment of extended XYZ is not understood; is a quote or bracket not closed?");
  EXPECT_EQ(error_of("1\nnote=[Lattice={5 0 0 0 6 0 0 0 7}\nC 1 2 3\n", "a.xyz").substr(0, 10), "a.xyz:2:6:");
  // What stands behind is read where nothing is hidden.
  EXPECT_EQ(read_text("1\ntitle=\"a Properties=species:S:1:v:R:1:pos:R:3\nC 0 1 2 3\n", "a.xyz").spheres.centre(0),
            (Vec3d{1, 2, 3}));
  for (const char* const lattice :
       {"\"5 0 0 0 6 0 0 0\"", "\"5 0 0 0 6 0 0 0 x\"", "[[5, 0], [0, 6]]", "fcc", "\"\"", "inf"})
    EXPECT_EQ(error_of("1\nLattice=" + std::string(lattice) + "\nC 1 2 3\n", "a.xyz")
                  .rfind("a.xyz:2: expected nine finite numbers in Lattice but found", 0),
              0u)
        << lattice;
}

TEST(Xyz, TakesTimeAndStep) {
  for (const char* const comment :
       {"Time=2.5 Properties=species:S:1:pos:R:3", "time=2.5", "i = 5, time = 2.500, E = -1", "T=\"2.5\"",
        "generated by trjconv t= 2.50000 step= 5"}) {
    const SphereFile file = read_text("1\n\nC 1 2 3\n1\n" + std::string(comment) + "\nC 1 2 3\n", "a.xyz", at_frame(1));
    EXPECT_EQ(file.time_ps, 2.5) << comment;
    EXPECT_NE(std::find(file.rules.begin(), file.rules.end(),
                        "time: that of the comment, taken as picoseconds, as the format names no unit"),
              file.rules.end());
  }
  EXPECT_EQ(read_text("1\nt= 2.5 step= 5\nC 1 2 3\n", "a.xyz").step, 5);
  for (const char* const comment : {"time=now", "time", "runtime=3", "note=\"time=3\"", "time=inf"})
    EXPECT_FALSE(read_text("1\n" + std::string(comment) + "\nC 1 2 3\n", "a.xyz").time_ps.has_value()) << comment;
}

TEST(Xyz, NamesWhatIsWrongWithProperties) {
  EXPECT_EQ(error_of("1\nProperties=species:S:1\nC\n", "a.xyz"),
            "a.xyz:2: expected columns x, y and z, but there is no x; Properties needs pos:R:3");
  for (const char* bad : {"pos:R", "pos:R:x", "pos:Q:3", ":R:3", "pos:R:0", "v:R:100000000000"})
    EXPECT_NE(error_of(std::string("1\nProperties=") + bad + "\nC 1 2 3\n", "a.xyz").find("a.xyz:2: expected"),
              std::string::npos)
        << bad;
  EXPECT_EQ(error_of("1\nProperties=pos:R:3\n1 2 3 4\n", "a.xyz"),
            "a.xyz:3:7: expected 3 columns (x y z) but found one more: '4'");
}

TEST(Xyz, NeverBelievesACount) {
  EXPECT_EQ(error_of("100000000000\n\nC 1 2 3\n", "a.xyz"),
            "a.xyz:3: the file ends in frame 0: line 1 promises 100000000000 spheres, but there are 1");
  EXPECT_EQ(error_of("1\n\nC 1 2 3\n9223372036854775807\n", "a.xyz"),
            "a.xyz:4: the file ends in frame 1: line 4 promises 9223372036854775807 spheres, but there are 0");
  EXPECT_EQ(error_of("99999999999999999999\n\nC 1 2 3\n", "a.xyz"),
            "a.xyz:1:1: expected the number of spheres of frame 0 but found '99999999999999999999'");
  EXPECT_EQ(error_of("1e11\n\nC 1 2 3\n", "a.xyz"),
            "a.xyz:1:1: expected the number of spheres of frame 0 but found '1e11'");
  EXPECT_EQ(error_of("-1\n\nC 1 2 3\n", "a.xyz"),
            "a.xyz:1:1: expected the number of spheres of frame 0 but found '-1'");
  EXPECT_EQ(error_of("0\n\n", "a.xyz"), "a.xyz: there are no spheres in it (read as XYZ)");
}

TEST(Xyz, NamesLineAndColumnOfAFault) {
  EXPECT_EQ(error_of("1\n\nC 1 two 3\n", "a.xyz"), "a.xyz:3:5: expected a number for y but found 'two'");
  EXPECT_EQ(error_of("1\n\nC 1 2 NaN\n", "a.xyz"), "a.xyz:3:7: z is not finite: 'NaN'");
  EXPECT_EQ(error_of("2\n\nC 1 2 3\nC 1 2\n", "a.xyz"), "a.xyz:4: expected 4 columns (symbol x y z) but found 3");
  EXPECT_EQ(error_of("1\n\nC 1 2 3\nC 4 5 6\n", "a.xyz"),
            "a.xyz:4:1: expected the number of spheres of frame 1 but found 'C'");
  EXPECT_EQ(error_of("1\n\nC 1 2 3\n8 4 5 6\n", "a.xyz"),
            "a.xyz:4:3: expected nothing but the number of spheres on this line, but found '4'");
}

TEST(Xyz, LeavesTextBehindTheLastFrameOutAndSaysSo) {
  const std::string frame = "1\n\nC 1 2 3\n";
  const SphereFile file = read_text(frame + frame + "\nVibrations follow\n 1 2 3\n", "a.xyz");
  EXPECT_EQ(file.frames, 2);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0],
            "a.xyz:8: the text from here on begins no frame and is left out ('Vibrations follow'); 2 frames were read");
  EXPECT_EQ(read_text(frame + "VEC1 5 0 0\n", "a.xyz").spheres.size(), 1);
  // A frame behind the text cannot be had, and one more sphere than the count is a fault.
  EXPECT_EQ(error_of(frame + "end\n", "a.xyz", at_frame(1)),
            "a.xyz:4:1: expected the number of spheres of frame 1 but found 'end'");
  EXPECT_EQ(error_of(frame + "H 1 2 3\n", "a.xyz"),
            "a.xyz:4:1: expected the number of spheres of frame 1 but found 'H'");
}

TEST(Xyz, WarnsOfALastLineWithoutEnd) {
  const SphereFile file = read_text("1\n\nC 1 2 12.7", "a.xyz");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "the last line of a.xyz has no end: the file may be cut");
}

TEST(Xyz, FindsACutInAFrameThatIsNotAskedFor) {
  const std::string first = "1\n\nC 1 2 3\n";
  EXPECT_EQ(error_of(first + "2\n\nC 1 2 3\n", "a.xyz"),
            "a.xyz:6: the file ends in frame 1: line 4 promises 2 spheres, but there are 1");
  EXPECT_EQ(error_of(first + "2\n\nC 1 2 3\nC 1", "a.xyz"),
            "a.xyz:7: expected 4 columns (symbol x y z) but found 2; the file is cut on this line");
}

}  // namespace
}  // namespace bihive
