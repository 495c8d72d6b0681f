// PSF: atoms and bonds, whose coordinates a trajectory gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "bihive/io/elements.h"
#include "bihive/io/formats/formats.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Blanks in place of the second water's segment; its hydrogen atoms are heavier than hydrogen is.
constexpr const char* kTwoWaters = R"(PSF EXT XPLOR

         2 !NTITLE
 REMARKS two waters
 REMARKS made by hand

         6 !NATOM
         1 WAT      1        TIP3     OH2      OT     -0.834000       15.9994           0   0.00000
         2 WAT      1        TIP3     H1       HT      0.417000       1.00800           0   0.00000
         3 WAT      1        TIP3     H2       HT      0.417000       1.00800           0   0.00000
         4          2A       TIP3     OH2      OT     -0.834000       15.9994           0   0.00000
         5          2A       TIP3     H1       HT      0.417000       3.02400           0   0.00000
         6          2A       TIP3     H2       HT      0.417000       3.02400           0   0.00000

         4 !NBOND: bonds
         1         2         1         3         4         5
         4         6

         0 !NTHETA: angles
)";

RawSpheres read_raw_psf(const std::string& text) {
  const Result<RawSpheres> raw = read_bytes(format_named("PSF"), text, "a.psf", 0, {});
  EXPECT_TRUE(raw.ok()) << raw.error().to_string();
  return raw.ok() ? *raw : RawSpheres{};
}

TEST(Psf, has_atoms_and_bonds) {
  const RawSpheres raw = read_raw_psf(kTwoWaters);
  ASSERT_EQ(raw.size(), 6u);
  EXPECT_FALSE(raw.has_positions);
  EXPECT_THAT(raw.attributes.element, ElementsAre(8, 1, 1, 8, 1, 1));
  EXPECT_EQ(raw.attributes.find_texts("chain")->of(0), "WAT");
  EXPECT_EQ(raw.attributes.find_texts("chain")->of(3), "");
  EXPECT_EQ(raw.attributes.find_texts("resname")->of(5), "TIP3");
  EXPECT_EQ(raw.attributes.find_texts("name")->of(3), "OH2");
  EXPECT_EQ(raw.attributes.find_texts("type")->of(3), "OT");
  EXPECT_EQ(raw.attributes.find_texts("insertion")->of(0), "");
  EXPECT_EQ(raw.attributes.find_texts("insertion")->of(3), "A");
  EXPECT_EQ(raw.attributes.find_numbers("resid")->values[3], 2);
  EXPECT_EQ(raw.attributes.find_numbers("charge")->values[3], -0.834);
  EXPECT_EQ(raw.attributes.find_numbers("mass")->values[5], 3.024);
  EXPECT_EQ(raw.attributes.find_numbers("serial")->values[5], 6);
  EXPECT_TRUE(raw.attributes.bonds.are_all);
  ASSERT_EQ(raw.attributes.bonds.list.size(), 4u);
  EXPECT_EQ(raw.attributes.bonds.list[3].one, 3);
  EXPECT_EQ(raw.attributes.bonds.list[3].other, 5);
}

TEST(Psf, errors_have_their_place) {
  const std::pair<std::pair<const char*, const char*>, const char*> cases[] = {
      {{"6 !NATOM", "7 !NATOM"}, "a.psf:14: expected 7 atoms (line 7) but found 6"},
      {{"6 !NATOM", "6 !ATOMS"}, "the bonds come before the atoms"},
      {{"0.417000       3.02400", "0.417000       heavy"}, "a.psf:12:"},
      {{"4 !NBOND", "5 !NBOND"}, "expected the number of an atom but found '0'"},
      {{"4         6\n", "4         7\n"}, "expected the number of an atom but found '7'"},
  };
  for (const auto& [change, message] : cases)
    EXPECT_THAT(test::error_of(test::with(kTwoWaters, change.first, change.second), "a.psf"), HasSubstr(message));
  EXPECT_EQ(test::error_of(kTwoWaters, "a.psf"),
            "a.psf: this is a topology (PSF), which has no coordinates; give its trajectory too, as in 'bihive render "
            "ATOMS.psf FILE.dcd'");
}

// Ten waters of CHARMM's columns, with a trajectory of them.
TEST(Psf, a_trajectory_gives_the_coordinates) {
  std::string text = "PSF\n\n       1 !NTITLE\n REMARKS water\n\n      30 !NATOM\n";
  char line[80];
  for (int i = 0; i < 30; ++i) {
    std::snprintf(line, sizeof line, "%8d %-4s %-4d %-4s %-4s %-4s %10.6f  %12.4f           0\n", i + 1, "W", i / 3 + 1,
                  "TIP3", i % 3 == 0 ? "OH2" : "H", i % 3 == 0 ? "OT" : "HT", i % 3 == 0 ? -0.834 : 0.417,
                  i % 3 == 0 ? 15.9994 : 1.008);
    text += line;
  }
  const std::string path = ::testing::TempDir() + "bihive_psf_test." + std::to_string(getpid()) + ".psf";
  std::ofstream(path) << text;
  ReadOptions options;
  options.trajectory = BIHIVE_SOURCE_DIR "/tests/data/io/trajectories/water.dcd";
  for (const std::int64_t frame : {0, 2}) {
    options.frame = frame;
    const Result<SphereFile> file = read_spheres(path, options);
    ReadOptions of_gro = options;
    const Result<SphereFile> same = read_spheres(BIHIVE_SOURCE_DIR "/tests/data/io/trajectories/water.gro", of_gro);
    ASSERT_TRUE(file && same) << (file ? same : file).error().to_string();
    ASSERT_EQ(file->spheres.size(), 30);
    EXPECT_EQ(file->frames, 3);
    for (std::int64_t id = 0; id < 30; ++id) {
      EXPECT_EQ(file->spheres.centre(id), same->spheres.centre(id));
      EXPECT_EQ(file->spheres.radius(id), van_der_waals_radius(id % 3 == 0 ? 8 : 1)) << id;
    }
  }
  // Without elements the radii are guesses, from the first frame's distances.
  std::string unknown = text;
  for (std::size_t at; (at = unknown.find("15.9994")) != std::string::npos;) unknown.replace(at, 7, "72.0000");
  for (std::size_t at; (at = unknown.find(" 1.0080")) != std::string::npos;) unknown.replace(at, 7, "72.5000");
  for (const char* name : {"OH2 ", "H   ", "TIP3"})
    for (std::size_t at; (at = unknown.find(name)) != std::string::npos;) unknown.replace(at, 4, "Q1  ");
  std::ofstream(path) << unknown;
  double radius = 0;
  for (const std::int64_t frame : {0, 2}) {
    options.frame = frame;
    const Result<SphereFile> file = read_spheres(path, options);
    ASSERT_TRUE(file) << file.error().to_string();
    EXPECT_TRUE(file->assumed_radii);
    if (frame == 0) radius = file->spheres.radius(0);
    EXPECT_GT(radius, 0.1);
    EXPECT_EQ(file->spheres.radius(7), radius);
  }
  std::remove(path.c_str());
}

}  // namespace
}  // namespace bihive
