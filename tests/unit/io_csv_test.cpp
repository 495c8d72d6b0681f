#include <gtest/gtest.h>

#include <cmath>

#include "bihive/image/transfer.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using test::number_names;
using test::numbers_of;
using test::read_text;

TEST(PlainText, TakesThreeColumnsOrFour) {
  const SphereFile four = read_text("# spheres\n\n1 2 3 0.5\n\t-4\t5e0   6  .25 # the last\n", "a.txt");
  EXPECT_EQ(four.format, "CSV");
  ASSERT_EQ(four.spheres.size(), 2);
  EXPECT_EQ(four.spheres.centre(1), (Vec3d{-4, 5, 6}));
  EXPECT_EQ(four.spheres.radius(1), 0.25);
  EXPECT_TRUE(four.warnings.empty());

  const SphereFile three = read_text("1,2,3\r\n4,5,6", "a");
  ASSERT_EQ(three.spheres.size(), 2);
  EXPECT_EQ(three.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(three.spheres.radius(1), double(float(0.5 * std::sqrt(27.0))));
  ASSERT_EQ(three.warnings.size(), 2u);
  EXPECT_EQ(three.warnings[0], "the last line of a has no end: the file may be cut");
  EXPECT_NE(three.warnings[1].find("radius sets another"), std::string::npos);
}

TEST(PlainText, TakesBlanksAndTabsInAnyMixture) {
  const SphereFile file = read_text("1 2\t3\n4\t5 \t6\n", "a.txt");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(number_names(read_text("x\ty\tz\tcolumn 4\n1\t2\t3\t4\n", "a.tsv")),
            (std::vector<std::string>{"column 4"}));
}

TEST(PlainText, NamesLineAndColumnOfAFault) {
  EXPECT_EQ(error_of("1 2 3\n4 5 abc\n", "a.txt"), "a.txt:2:5: expected a number for z but found 'abc'");
  EXPECT_EQ(error_of("1 2 3\n4 nan 6\n", "a.txt"), "a.txt:2:3: y is not finite: 'nan'");
  EXPECT_EQ(error_of("1 2 3\n\n-inf 5 6\n", "a.txt"), "a.txt:3:1: x is not finite: '-inf'");
  EXPECT_EQ(error_of("1 2 1e39\n", "a.txt"), "a.txt:1:5: z is beyond single precision (3.4e38): '1e39'");
  EXPECT_EQ(error_of("1 2 3 1\n1 2 3 -1\n", "a.txt"), "a.txt:2:7: radius is negative: '-1'");
  EXPECT_EQ(error_of("1 2 3 inf\n", "a.txt"), "a.txt:1:7: radius is not finite: 'inf'");
  EXPECT_EQ(error_of("1 2 3 1\n1 2 3\n", "a.txt"), "a.txt:2: expected 4 columns (x y z radius) but found 3");
  EXPECT_EQ(error_of("1 2 3\n1 2 3 4\n", "a.txt"), "a.txt:2:7: expected 3 columns (x y z) but found one more: '4'");
  EXPECT_EQ(
      error_of("1 2 3 4 5\n", "a.txt"),
      "a.txt:1: expected 'x y z' or 'x y z r' but found 5 columns; name the columns in a header line, or say which "
      "they are: columns x=1,y=2,z=3");
  EXPECT_EQ(error_of("1;2,5;3\n", "a.csv"), "a.csv:1:3: expected a number for y but found '2,5'");
  EXPECT_EQ(error_of("# nothing\n\n", "a.txt"), "a.txt:2: there is no line with numbers in it");
}

TEST(Csv, TakesColumnsByName) {
  const SphereFile file = read_text(
      "name,Radius,x,Y,z,charge,element,type\n"
      "\"one, first\",0.5,1,2,3,-0.25,Fe,7\n"
      "# a comment\n"
      "two,1.5,4,5,6,,c,9\n",
      "a.csv");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file.spheres.radius(1), 1.5);
  const SphereAttributes& attributes = file.spheres.attributes();
  EXPECT_EQ(attributes.element, (std::vector<std::uint8_t>{26, 6}));
  EXPECT_EQ(attributes.type, (std::vector<std::int32_t>{7, 9}));
  EXPECT_EQ(number_names(file), (std::vector<std::string>{"charge"}));
  EXPECT_EQ(numbers_of(file, "charge")[0], -0.25);
  EXPECT_TRUE(std::isnan(numbers_of(file, "charge")[1])) << "a gap is no number";
  EXPECT_EQ(file.rules[0], "columns by the header: name Radius x Y z charge element type");
  const NamedTexts* const names = attributes.find_texts("name");
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->texts, (std::vector<std::string>{"one, first", "two"}));
  EXPECT_EQ(names->of(1), "two");
}

TEST(Csv, KeepsTextsOnceAndCountsTheirMemory) {
  const SphereFile file = read_text(
      "x,y,z,r,phase,note,nothing\n"
      "1,2,3,1,solid,,\n"
      "2,2,3,1,solid,late,\n"
      "3,2,3,1,liquid,late,\n",
      "a.csv");
  const SphereAttributes& attributes = file.spheres.attributes();
  ASSERT_EQ(attributes.texts.size(), 2u);
  EXPECT_EQ(attributes.texts[0].texts, (std::vector<std::string>{"solid", "liquid"}));
  EXPECT_EQ(attributes.texts[0].text_of_sphere, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(attributes.texts[1].texts, (std::vector<std::string>{"", "late"})) << "a gap before the first text";
  EXPECT_EQ(attributes.texts[1].text_of_sphere, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(file.rules.back(), "empty columns are left out: nothing");
  SphereAttributes without = attributes;
  without.texts.clear();
  EXPECT_GE(attributes.allocated_bytes() - without.allocated_bytes(),
            static_cast<std::int64_t>(6 * sizeof(std::int32_t) + 4 * sizeof(std::string)));
}

TEST(Csv, SeparatesBySemicolonTabOrBlanks) {
  for (const char* text :
       {"x;y;z;r\n1;2;3;4\n", "x\ty\tz\tr\n1\t2\t3\t4\n", "x y  z r\n1  2 3 4\n", "x, y, z, r\n1, 2, 3, 4"}) {
    const SphereFile file = read_text(text, "a.csv");
    ASSERT_EQ(file.spheres.size(), 1) << text;
    EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3})) << text;
    EXPECT_EQ(file.spheres.radius(0), 4) << text;
  }
}

TEST(Csv, HalvesADiameter) {
  EXPECT_EQ(read_text("x,y,z,diameter\n0,0,0,3\n", "a.csv").spheres.radius(0), 1.5);
}

TEST(Csv, TakesRAsTheRadiusButRgbAsAColour) {
  const SphereFile radius = read_text("x,y,z,r,g\n0,0,0,2,5\n", "a.csv");
  EXPECT_EQ(radius.spheres.radius(0), 2);
  EXPECT_TRUE(radius.spheres.attributes().colour.empty());
  EXPECT_EQ(numbers_of(radius, "g"), (std::vector<double>{5}));

  const SphereFile linear = read_text("x,y,z,radius,r,g,b\n0,0,0,2,1,0.5,0\n", "a.csv");
  EXPECT_EQ(linear.spheres.radius(0), 2);
  ASSERT_EQ(linear.spheres.attributes().colour.size(), 1u);
  EXPECT_EQ(linear.spheres.attributes().colour[0], (Vec3f{1, 0.5f, 0}));
}

TEST(Csv, TakesColoursAsBytesIfAnyIsAboveOne) {
  const SphereFile file = read_text("x,y,z,red,green,blue,opacity\n0,0,0,255,51,0,0.5\n1,0,0,1,0,0,1\n", "a.csv");
  const auto linear = [](int byte) { return static_cast<float>(linear_from_srgb(byte / 255.0)); };
  const SphereAttributes& attributes = file.spheres.attributes();
  EXPECT_EQ(attributes.colour[0], (Vec3f{1, linear(51), 0}));
  EXPECT_EQ(attributes.colour[1], (Vec3f{linear(1), 0, 0}));
  EXPECT_EQ(attributes.opacity, (std::vector<float>{0.5f, 1}));
  EXPECT_EQ(error_of("x,y,z,red,green,blue\n0,0,0,256,0,0\n", "a.csv"), "a.csv:2:7: red is outside 0 to 255: '256'");
  EXPECT_EQ(error_of("x,y,z,red,green,blue\n0,0,0,0,nan,0\n", "a.csv"), "a.csv:2:9: green is outside 0 to 255: 'nan'");
  EXPECT_EQ(error_of("x,y,z,opacity\n0,0,0,1.5\n", "a.csv"),
            "a.csv:2:7: opacity is outside 0 to 1: '1.5'; keep it as a number: columns NAME=opacity");
}

TEST(Csv, NumbersLabelsInOrderOfAppearance) {
  const SphereFile file = read_text("x,y,z,type\n0,0,0,sand\n1,0,0,clay\n2,0,0,sand\n", "a.csv");
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 1}));
  const SphereFile mixed = read_text("x,y,z,element\n0,0,0,C\n1,0,0,wax\n2,0,0,8\n", "a.csv");
  EXPECT_EQ(mixed.spheres.attributes().element, (std::vector<std::uint8_t>{6, 0, 8}));
  EXPECT_EQ(mixed.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 3}));
}

TEST(Csv, NamesWhatIsWrongWithAHeader) {
  EXPECT_EQ(error_of("a,b,c\n1,2,3\n", "a.csv"),
            "a.csv:1: expected columns x, y and z, but there is no x in the header 'a b c'; "
            "say which columns they are: columns x=NAME,y=NAME,z=NAME");
  EXPECT_EQ(error_of("x,y,z,X\n1,2,3,4\n", "a.csv"),
            "a.csv:1: expected one column x only in the header 'x y z X'; "
            "say which columns they are: columns x=NAME,y=NAME,z=NAME");
  EXPECT_EQ(error_of("x,y,z,r,radius\n1,2,3,4,5\n", "a.csv"),
            "a.csv:1: expected one column for the radius or diameter only in the header 'x y z r radius'; "
            "say which columns they are: columns x=NAME,y=NAME,z=NAME");
  EXPECT_EQ(error_of("x,y,z,red,blue\n1,2,3,4,5\n", "a.csv"),
            "a.csv:1: expected red, green and blue once each, or none of them in the header 'x y z red blue'; "
            "say which columns they are: columns x=NAME,y=NAME,z=NAME");
  EXPECT_EQ(error_of("x,y,z\n", "a.csv"), "a.csv: there are no spheres in it (read as CSV)");
  std::string wide = "x,y,z";
  for (int i = 0; i < 2000; ++i) wide += ",c" + std::to_string(i);
  EXPECT_NE(error_of(wide + "\n1,2,3\n", "a.csv").find("a.csv:1: expected at most 1000 columns"), std::string::npos);
}

TEST(Csv, TellsTextForPeople) {
  EXPECT_EQ(
      error_of("Dear Anna,\n\nwe met on 3 May 2026.\nYours, Ben\n", "letter.txt"),
      "letter.txt: this looks like text for people: no line of it has three numbers; a table of spheres has a line "
      "for each, with x, y and z");
  EXPECT_NE(error_of("a,b,c\n1,2,3\n", "table.csv").find("there is no x in the header"), std::string::npos);
}

TEST(Csv, MakesNamesPrintable) {
  const SphereFile file = read_text("x,y,z,\x1b[31mred,Gr\xf6\xdf\x65,\u00c5\n1,2,3,4,5,6\n", "a.csv");
  EXPECT_EQ(number_names(file), (std::vector<std::string>{"?[31mred", "Gr??e", "\u00c5"}));
}

TEST(Csv, NamesLineAndColumnOfAFault) {
  EXPECT_EQ(error_of("x,y,z\n1,2,3\n4,5,\n", "a.csv"), "a.csv:3:5: expected a number for z but found ''");
  EXPECT_EQ(error_of("x,y,z\n1,2\n", "a.csv"), "a.csv:2: expected 3 columns (x y z) but found 2");
  EXPECT_EQ(error_of("x,y,z\n1,2,3,4\n", "a.csv"), "a.csv:2:7: expected 3 columns (x y z) but found one more: '4'");
  EXPECT_EQ(error_of("x,y,z,t\n1,2,3,4\n1,2,3,hot\n", "a.csv"), "a.csv:3:7: expected a number for t but found 'hot'");
  EXPECT_EQ(error_of("x,y,z\n1,\"2\n", "a.csv"), "a.csv:2:3: expected a number for y but found '\"2'");
}

}  // namespace
}  // namespace bihive
