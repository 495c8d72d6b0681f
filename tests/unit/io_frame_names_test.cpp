// Labels, chains and other texts over the frames of a file: each name keeps its number.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/frames.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::read_text;

// One frame for each list of labels.
std::string xyz(const std::vector<std::vector<std::string>>& frames) {
  std::string text;
  for (const std::vector<std::string>& labels : frames) {
    text += std::to_string(labels.size()) + "\n\n";
    for (std::size_t i = 0; i < labels.size(); ++i) text += labels[i] + " " + std::to_string(2 * i) + " 0 0\n";
  }
  return text;
}

std::vector<std::int32_t> types_of(const SphereFile& file) {
  return file.spheres.attributes().type;
}

std::vector<std::string> labels_of(const SphereFile& file) {
  const NamedTexts* const labels = file.spheres.attributes().find_texts("type");
  std::vector<std::string> names;
  for (std::size_t i = 0; labels != nullptr && i < labels->text_of_sphere.size(); ++i) names.push_back(labels->of(i));
  return names;
}

using Types = std::vector<std::int32_t>;

TEST(FrameNames, LabelsKeepTheirNumbersWhateverFrameIsRead) {
  const std::vector<std::vector<std::string>> labels = {{"AA", "BB"}, {"BB", "AA"},       {"DD", "BB", "CC"},
                                                        {"EE"},       {"CC", "AA", "DD"}, {"BB", "BB"}};
  const Types expected[] = {{1, 2}, {2, 1}, {3, 2, 4}, {5}, {4, 1, 3}, {2, 2}};
  const std::string text = xyz(labels), path = ::testing::TempDir() + "bihive_frame_names." + std::to_string(getpid());
  ASSERT_TRUE(write_file(path, text).ok());
  for (const std::vector<std::int64_t>& order :
       {std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}, {5, 4, 3, 2, 1, 0}, {4, 2, 5, 0, 3, 1}, {3}}) {
    const Result<std::shared_ptr<const Frames>> frames = open_frames(path, {});
    ASSERT_TRUE(frames.ok());
    for (const std::int64_t frame : order) {
      const Result<SphereFile> read = (*frames)->read(frame);
      ASSERT_TRUE(read.ok()) << read.error().to_string();
      EXPECT_EQ(types_of(*read), expected[frame]) << frame;
      EXPECT_EQ(labels_of(*read), labels[static_cast<std::size_t>(frame)]) << frame;
      EXPECT_EQ(types_of(read_text(text, "a.xyz", at_frame(frame))), expected[frame]) << frame;
    }
  }
  std::remove(path.c_str());
}

TEST(FrameNames, ChainsAndNumbersOfTypes) {
  const auto atom = [](char chain, int x) {
    return std::string("ATOM      1  CA  ALA ") + chain + "   1    " + "   " + std::to_string(x) +
           ".000   0.000   0.000  1.00  0.00           C  \n";
  };
  const std::string pdb =
      "MODEL 1\n" + atom('A', 1) + atom('B', 5) + "ENDMDL\nMODEL 2\n" + atom('C', 1) + atom('B', 5) + "ENDMDL\n";
  const SphereFile second = read_text(pdb, "a.pdb", at_frame(1));
  const NamedTexts* const chain = second.spheres.attributes().find_texts("chain");
  ASSERT_NE(chain, nullptr);
  EXPECT_EQ(chain->text_of_sphere, (Types{2, 1}));
  EXPECT_EQ(chain->texts, (std::vector<std::string>{"A", "B", "C"}));

  // Types that are numbers stay what they are.
  const std::string head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n";
  const std::string dump =
      head + "ITEM: ATOMS type x y z\n7 1 1 1\n9 2 2 2\n" + head + "ITEM: ATOMS type x y z\n9 1 1 1\n2 2 2 2\n";
  EXPECT_EQ(types_of(read_text(dump, "a.dump", at_frame(1))), (Types{9, 2}));
}

// Thousands of molecules, each of which costs reading the file: only the first one and the frame's own names count.
TEST(FrameNames, FilesThatAreReadWholeForEachFrame) {
  const auto molecule = [](const std::vector<std::string>& names) {
    std::string text =
        "@<TRIPOS>MOLECULE\nm\n" + std::to_string(names.size()) + " 0 0 0 0\nSMALL\nNO_CHARGES\n\n@<TRIPOS>ATOM\n";
    for (std::size_t i = 0; i < names.size(); ++i)
      text += std::to_string(i + 1) + " " + names[i] + " " + std::to_string(2 * i) + " 0 0 C.3 1 LIG 0\n";
    return text;
  };
  const std::string text = molecule({"C1", "C2"}) + molecule({"C3", "C2"}) + molecule({"C4", "C3", "C1"});
  const auto numbers = [&](std::int64_t frame) {
    const SphereFile file = read_text(text, "a.mol2", at_frame(frame));
    const NamedTexts* const names = file.spheres.attributes().find_texts("name");
    return names == nullptr ? Types() : names->text_of_sphere;
  };
  EXPECT_EQ(numbers(0), (Types{0, 1}));
  EXPECT_EQ(numbers(1), (Types{2, 1}));
  EXPECT_EQ(numbers(2), (Types{2, 3, 0}));
}

TEST(FrameNames, AnEmptyFrameSaysItsNumber) {
  const std::string text = xyz({{"AA"}, {}, {"BB"}});
  EXPECT_EQ(error_of(text, "a.xyz", at_frame(1)), "a.xyz: there are no spheres in frame 1 (read as XYZ)");
  EXPECT_EQ(error_of("0\n\n", "a.xyz"), "a.xyz: there are no spheres in it (read as XYZ)");
  EXPECT_EQ(types_of(read_text(text, "a.xyz", at_frame(2))), (Types{2}));
  // Or it is an empty set, also where a radius and a middle are asked of it.
  const std::string path = ::testing::TempDir() + "bihive_frame_names." + std::to_string(getpid());
  ASSERT_TRUE(write_file(path, text).ok());
  ReadOptions options;
  options.recenter = true;
  options.radius_scale = 2;
  const Result<std::shared_ptr<const Frames>> frames = open_frames(path, options, {.empty_frames = true});
  ASSERT_TRUE(frames.ok());
  const Result<SphereFile> empty = (*frames)->read(1);
  ASSERT_TRUE(empty.ok()) << empty.error().to_string();
  EXPECT_EQ(empty->spheres.size(), 0);
  EXPECT_EQ(empty->recentred_by, Vec3d{});
  EXPECT_EQ((*frames)->read(2)->spheres.size(), 1);
  std::remove(path.c_str());
}

}  // namespace
}  // namespace bihive
