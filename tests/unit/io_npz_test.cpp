// Archives that NumPy wrote (tests/data/io/make_npy.py), and damaged ones.
#include <gtest/gtest.h>

#include "bihive/base/write_file.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::number_names;
using test::numbers_of;
using test::read_text;

std::string archive(const std::string& name) {
  return *read_file(std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/" + name);
}

TEST(Npz, TakesArraysAsColumns) {
  for (const char* name : {"columns.npz", "columns_packed.npz"}) {
    const SphereFile file = read_text(archive(name), "a");
    EXPECT_EQ(file.format, "NPZ");
    ASSERT_EQ(file.spheres.size(), 2);
    EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3}));
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{-4, 5, 6}));
    EXPECT_EQ(file.spheres.radius(1), 0.25);
    EXPECT_EQ(number_names(file), (std::vector<std::string>{"v_1", "v_2", "v_3"}));
    EXPECT_EQ(numbers_of(file, "v_2"), (std::vector<double>{2, 5}));
    bool said = false;
    for (const std::string& rule : file.rules)
      said = said || rule == "arrays of another length or kind are left out: name box";
    EXPECT_TRUE(said);
    EXPECT_TRUE(file.warnings.empty());
  }
}

TEST(Npz, TakesOneArrayOfPlaces) {
  const SphereFile file = read_text(archive("places.npz"), "a.npz");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(numbers_of(file, "charge"), (std::vector<double>{1, -1}));
}

TEST(Npz, SaysWhatIsWrong) {
  EXPECT_NE(error_of(archive("places.npz"), "a", at_frame(1)).find("there is no frame 1"), std::string::npos);
  const std::string whole = archive("columns_packed.npz");
  EXPECT_EQ(error_of(whole.substr(0, 200), "a"), "a: the zip archive is cut: it has no directory");
  // Places under another name.
  std::string other = archive("places.npz");
  for (std::size_t at = other.find("positions"); at != std::string::npos; at = other.find("positions"))
    other.replace(at, 9, "somethin_");
  EXPECT_EQ(
      error_of(other, "a").rfind("a: no array of the NPZ file holds the places: it has somethin_ charge; name", 0), 0u);
  // The files of another program.
  std::string texts = archive("places.npz");
  for (std::size_t at = texts.find(".npy"); at != std::string::npos; at = texts.find(".npy"))
    texts.replace(at, 4, ".txt");
  EXPECT_EQ(
      error_of(texts, "a.zip"),
      "a.zip: this is a ZIP archive without arrays of NumPy; it has positions.txt, charge.txt; unpack it, and take the "
      "file with the spheres");
  // Any changed byte gives an answer or an error.
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0xff);
    (void)read_spheres_from_memory(damaged, "a.npz", {});
    (void)read_spheres_from_memory(std::string_view(whole).substr(0, i), "a.npz", {});
  }
}

}  // namespace
}  // namespace bihive
