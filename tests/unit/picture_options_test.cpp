// The table of all options of a picture, and how settings are taken by it.
// ctest: needs bihive_job
#include "bihive/job/picture_options.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "bihive/job/failure.h"

namespace bihive {
namespace {

PictureRequest taken(const std::vector<std::string>& words) {
  PictureRequest request;
  take_words(request, words);
  return request;
}

std::string refusal_of(const std::vector<std::string>& words) {
  try {
    taken(words);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code, kBadUsage);
    return failure.error.to_string();
  }
  return "";
}

TEST(PictureOptions, EachHasAnIdOfItsOwnAndSaysHowItWorksOnRanks) {
  std::set<std::string> ids;
  for (const RequestOption<PictureRequest>& row : picture_options()) {
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_FALSE(row.help.empty()) << row.id;
    // The default is to refuse. Sticks are between spheres of several ranks, and so are the walls of cavities; trees
    // are searched for whole sets.
    const bool is_of_several =
        std::set<std::string>{"bonds", "bond_reach", "bond_orders", "no_bond_orders", "stick_radius", "ball_scale"}
            .contains(std::string(row.id)) ||
        row.id.starts_with("arrow") || row.id.starts_with("link") || row.id.starts_with("trace") ||
        row.id.starts_with("trail") || row.id.starts_with("hbond") || row.id == "no_hbonds" ||
        row.id == "show_cavities" || row.id == "show_contacts" || row.id == "tune";
    EXPECT_EQ(row.ranks == ParameterRanks::refused, is_of_several) << row.id;
  }
  for (const RequestOption<PictureRequest>& row : picture_options())
    for (const std::string& other : row.excludes) EXPECT_TRUE(ids.contains(other)) << row.id << " excludes " << other;
}

TEST(PictureOptions, WordsAreTakenInTheirOrder) {
  const PictureRequest request = taken({"--view-from=left", "--samples", "16", "--opacity=0.5", "--select=chain A",
                                        "--colour", "red", "--hide", "--no-shadows", "--", "a=b.pdb"});
  EXPECT_EQ(request.view_from, ViewFrom::left);
  EXPECT_EQ(std::get<std::int64_t>(*request.picture.find("samples_per_pixel")), 16);
  EXPECT_EQ(request.looks.words,
            (std::vector<std::string>{"--opacity 0.5", "--select chain A", "--colour red", "--hide"}));
  EXPECT_EQ(request.input.input, "a=b.pdb");
  EXPECT_EQ(request.given.front().id, "view_from");
  EXPECT_EQ(request.given.back().id, "no_shadows");
}

TEST(PictureOptions, ASizeInPrintHasThePixelsOfItsInches) {
  const auto pixels_of = [](const std::vector<std::string>& words) {
    PictureSettings picture;
    taken(words).picture.apply_to(picture);
    return std::pair(picture.width_px, picture.height_px);
  };
  EXPECT_EQ(pixels_of({"--size=8.5cmx6cm", "--dpi=300"}), std::pair(1004, 709));
  EXPECT_EQ(pixels_of({"--dpi=300", "--size=8.5x6cm"}), std::pair(1004, 709));
  EXPECT_EQ(pixels_of({"--size=3.5inx144pt", "--dpi=100"}), std::pair(350, 200));
  EXPECT_EQ(pixels_of({"--size=254x25.4mm", "--dpi=72"}), std::pair(720, 72));
  EXPECT_EQ(pixels_of({"--size=640x480", "--dpi=72"}), std::pair(640, 480));
  for (const char* size : {"8.5cm", "8.5x6", "x6cm", "0x6cm", "-1x6cm", "8x6m", "nanx6cm", "8x6 cm"})
    EXPECT_THROW(taken({"--size=" + std::string(size), "--dpi=300"}), Failure) << size;
  EXPECT_THROW(taken({"--size=100x100in", "--dpi=1000"}), Failure);
}

TEST(PictureOptions, ARadiusScaleIsOfTheFileBeforeASelectionAndOfItsSpheresAfter) {
  const PictureRequest request = taken({"--radius-scale=2", "--select=chain A", "--radius-scale=3"});
  EXPECT_EQ(request.input.reading.options().radius_scale, 2);
  EXPECT_EQ(request.looks.looks.size(), 1U);
}

TEST(PictureOptions, RefusalsNameTheSetting) {
  EXPECT_EQ(refusal_of({"--fgo=0.3"}), "there is no option fgo; did you mean fog?");
  EXPECT_EQ(refusal_of({"--fov=200"}).substr(0, 5), "fov: ");
  EXPECT_EQ(refusal_of({"--zoom=2", "--zoom=3"}), "zoom is given more than once");
  EXPECT_EQ(refusal_of({"--ao", "--no-ao"}), "no_ao excludes ao");
  EXPECT_EQ(refusal_of({"--no-ao", "--ao"}), "no_ao excludes ao");
}

}  // namespace
}  // namespace bihive
