#include <gtest/gtest.h>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;

const char* const kTwoFrames =
    "Water, t= 1.50000 step= 300\n"
    "    3\n"
    "    1SOL     OW    1   0.126   1.624   1.679  0.1227 -0.0580  0.0434\n"
    "    1SOL    HW1    2   0.190   1.661   1.747  0.8085  0.3191 -0.7791\n"
    "    2CLA    CLA    3   0.177   1.568  -1.613 -0.9045 -2.6469  1.3180\n"
    "   1.82060   1.82060   1.82060\n"
    "again, t= 2.0\n"
    "    3\n"
    "    1SOL     OW    1   1.000   2.000   3.000\n"
    "    1SOL    HW1    2   0.190   1.661   1.747\n"
    "    2CLA    CLA    3   0.177   1.568   1.613\n"
    "   2.0 3.0 4.0 0.0 0.0 0.5 0.0 0.25 0.125\n";

TEST(Gro, TakesFixedColumnsAsAngstrom) {
  const SphereFile file = read_text(kTwoFrames, "w.gro");
  EXPECT_EQ(file.format, "GRO");
  EXPECT_EQ(file.frames, 2);
  ASSERT_EQ(file.spheres.size(), 3);
  EXPECT_NEAR(file.spheres.centre(0).y, 16.24, 1e-5);
  EXPECT_NEAR(file.spheres.centre(2).z, -16.13, 1e-5);
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{8, 1, 17}));
  EXPECT_EQ(*file.time_ps, 1.5);
  EXPECT_EQ(*file.step, 300);
  EXPECT_EQ(numbers_of(file, "vy"), (std::vector<double>{-0.058, 0.3191, -2.6469}));
  EXPECT_EQ(numbers_of(file, "resid"), (std::vector<double>{1, 1, 2}));
  EXPECT_EQ(numbers_of(file, "serial"), (std::vector<double>{1, 2, 3}));
  ASSERT_TRUE(file.spheres.cell().has_value());
  EXPECT_NEAR(file.spheres.cell()->vectors[2].z, 18.206, 1e-12);
}

TEST(Gro, TakesALaterFrameAndATiltedBox) {
  const SphereFile file = read_text(kTwoFrames, "w.gro", at_frame(1));
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{10, 20, 30}));
  EXPECT_EQ(*file.time_ps, 2);
  EXPECT_EQ(file.spheres.cell()->vectors[1], (Vec3d{5, 30, 0}));
  EXPECT_EQ(file.spheres.cell()->vectors[2], (Vec3d{2.5, 1.25, 40}));
  EXPECT_NE(error_of(kTwoFrames, "w.gro", at_frame(2)).find("frame 2"), std::string::npos);
}

TEST(Gro, TakesMoreDecimals) {
  const SphereFile file = read_text("t\n 1\n    1SOL     OW    1   0.12345   1.62345   1.67345\n 1 1 1\n", "a.txt");
  EXPECT_EQ(file.format, "GRO");
  EXPECT_NEAR(file.spheres.centre(0).x, 1.2345, 1e-6);
}

// huge_box.gro of MDAnalysis' tests: numbers that fill their columns of ten.
TEST(Gro, TakesABoxWithoutBlanks) {
  const SphereFile file =
      read_text("t\n 1\n    1SOL     OW    1   0.123   1.623   1.673\n40000.0000041000.0000042000.50000\n", "a.gro");
  ASSERT_TRUE(file.spheres.cell().has_value());
  EXPECT_EQ(file.spheres.cell()->vectors[0], (Vec3d{400000, 0, 0}));
  EXPECT_EQ(file.spheres.cell()->vectors[2], (Vec3d{0, 0, 420005}));
  EXPECT_NE(error_of("t\n 1\n    1SOL     OW    1   0.123   1.623   1.673\n1.5.0.25 1 1\n", "a.gro").find("1.5.0.25"),
            std::string::npos);
}

TEST(Gro, SaysWhereItIsWrong) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = kTwoFrames;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(error_of(changed("1.661   1.747  0.8085", "1.x61   1.747  0.8085"), "w.gro").rfind("w.gro:4:29: ", 0), 0u);
  EXPECT_EQ(error_of(changed("   1.82060   1.82060   1.82060", "   1.82060   1.82060"), "w.gro").rfind("w.gro:6: ", 0),
            0u);
  EXPECT_EQ(error_of(changed("    3\n", "    x\n"), "w.gro").rfind("w.gro:2:5: ", 0), 0u);
  const std::string cut = std::string(kTwoFrames).substr(0, 180);
  EXPECT_NE(error_of(cut, "w.gro").find("w.gro:"), std::string::npos);
}

}  // namespace
}  // namespace bihive
