// Frames of a file in the viewer: what stays from one to the next, and that each is the picture of the frame alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "bihive/viewer/load_file.h"
#include "bihive/viewer/viewer.h"

namespace bihive {
namespace {

// Each frame is wider than the one before, and the last one has one sphere more.
const std::string kFrames =
    "3\nfirst\nC 0 0 0\nO 2 0 0\nC 0 2 0\n"
    "3\nsecond\nC 0 0 1\nO 3 0 0\nC 0 3 0\n"
    "4\nthird\nC 0 1 0\nO 5 0 0\nC 0 5 0\nN 1 1 1\n";

SphereFile frame_of(std::int64_t frame) {
  ReadOptions options;
  options.frame = frame;
  return read_spheres_from_memory(kFrames, "run.xyz", options).value();
}

std::uint64_t saved(Viewer& viewer) {
  return picture_hash(viewer.picture(48, 32, 1).value());
}

// The picture of a viewer that knows this frame alone.
std::uint64_t alone(std::int64_t frame, const ViewerSettings& settings, const ViewerLook& look) {
  Viewer viewer;
  viewer.resize(48, 32);
  EXPECT_TRUE(viewer.load(frame_of(frame), "run.xyz"));
  EXPECT_TRUE(viewer.set_look(look));
  EXPECT_TRUE(viewer.set(settings));
  return saved(viewer);
}

class ViewerFrames : public testing::Test {
 protected:
  void SetUp() override {
    viewer.resize(48, 32);
    ASSERT_TRUE(viewer.load(kFrames, "run.xyz"));
    ASSERT_EQ(viewer.facts().frames, 3);
  }
  void show(std::int64_t frame) {
    const Result<std::shared_ptr<PreparedFrame>> made = viewer.frame_maker()->make(frame_of(frame));
    ASSERT_TRUE(made) << made.error().to_string();
    const Result<bool> shown = viewer.show_frame(**made);
    ASSERT_TRUE(shown) << shown.error().to_string();
    ASSERT_TRUE(*shown);
  }

  Viewer viewer;
};

TEST_F(ViewerFrames, each_is_its_own_picture_by_the_same_camera) {
  viewer.orbit(7, 3);
  const Camera camera = viewer.settings().camera;
  for (const std::int64_t frame : {2, 1, 0, 2}) {
    show(frame);
    EXPECT_EQ(viewer.settings().camera, camera) << frame;
    EXPECT_EQ(viewer.facts().spheres, frame == 2 ? 4 : 3);
    EXPECT_EQ(saved(viewer), alone(frame, viewer.settings(), viewer.look())) << frame;
    // On the screen as well.
    Result<FrameReport> report = viewer.frame(1000);
    for (int i = 0; report && !report->settled && i < 1000; ++i) report = viewer.frame(1000);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->settled);
  }
}

TEST_F(ViewerFrames, the_look_and_the_range_of_its_colours_stay) {
  ViewerLook look = viewer.look();
  look.style = "flat";
  look.rows = {{"element O", "colour", "orange"}};
  look.colour_by = "x:magma";
  ASSERT_TRUE(viewer.set_look(look));
  const auto first = viewer.scene().coloured_by.back().range;
  ASSERT_TRUE(first);
  EXPECT_EQ(first->second, 2);
  show(2);
  EXPECT_EQ(viewer.look(), look);
  EXPECT_EQ(viewer.scene().coloured_by.back().range, first);
  look.colour_by = "x:magma:0,2";
  EXPECT_EQ(saved(viewer), alone(2, viewer.settings(), look));
}

TEST_F(ViewerFrames, a_frame_from_before_another_look_is_made_anew) {
  const Result<std::shared_ptr<PreparedFrame>> old = viewer.frame_maker()->make(frame_of(1));
  ASSERT_TRUE(old);
  const auto maker = viewer.frame_maker();
  EXPECT_EQ(maker, viewer.frame_maker()) << "the same one while nothing changes";
  ViewerLook look = viewer.look();
  look.background = "black";
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_NE(maker, viewer.frame_maker());
  const std::uint64_t before = saved(viewer);
  const Result<bool> shown = viewer.show_frame(**old);
  ASSERT_TRUE(shown);
  EXPECT_FALSE(*shown);
  EXPECT_EQ(saved(viewer), before);
  show(1);
  EXPECT_NE(saved(viewer), before);
}

TEST_F(ViewerFrames, a_frame_that_cannot_be_shown_leaves_the_one_before) {
  ViewerLook look = viewer.look();
  look.rows = {{"z <= 0.5 and y < 0.5 or y > 1.5", "hide", ""}};
  show(1);
  ASSERT_TRUE(viewer.set_look(look));
  const std::uint64_t before = saved(viewer);
  const Result<std::shared_ptr<PreparedFrame>> made = viewer.frame_maker()->make(frame_of(0));
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().to_string().find("hidden"), std::string::npos) << made.error().to_string();
  EXPECT_EQ(saved(viewer), before);
}

TEST_F(ViewerFrames, are_made_on_another_thread) {
  Result<std::shared_ptr<PreparedFrame>> made = Error{"", "", 0, 0, ""};
  const std::shared_ptr<const FrameMaker> maker = viewer.frame_maker();
  std::thread reader([&] { made = maker->make(frame_of(2)); });
  for (int i = 0; i < 20; ++i) {
    viewer.orbit(5, 1);
    EXPECT_TRUE(viewer.frame(1));
  }
  reader.join();
  ASSERT_TRUE(made);
  ASSERT_TRUE(viewer.show_frame(**made));
  EXPECT_EQ(saved(viewer), alone(2, viewer.settings(), viewer.look()));
}

TEST(ViewerScene, has_no_frames) {
  Viewer viewer;
  EXPECT_EQ(viewer.frame_maker(), nullptr);
  ASSERT_TRUE(viewer.load_built_in("four-spheres"));
  EXPECT_EQ(viewer.frame_maker(), nullptr);
}

TEST(LoadFile, is_the_same_in_pieces) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "bihive_load_file_test";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "run.xyz").string(), scene = (folder / "a.json").string();
  std::ofstream(path) << kFrames;
  std::ofstream(scene) << R"({"bihive_scene": 2, "spheres": [[0, 0, 0, 1]]})";
  ReadOptions options;
  options.frame = 1;
  std::uint64_t hashes[2] = {};
  for (const bool whole : {true, false}) {
    Viewer viewer;
    viewer.resize(48, 32);
    const Result<LoadedFile> loaded = load_file(viewer, path, options, whole ? 1000 : 0);
    ASSERT_TRUE(loaded) << loaded.error().to_string();
    EXPECT_EQ(loaded->facts.spheres, 3);
    EXPECT_EQ(loaded->facts.name, path);
    ASSERT_NE(loaded->frames, nullptr);
    EXPECT_EQ(loaded->frames->count(), 3);
    EXPECT_EQ(loaded->frames->read(2)->spheres.size(), 4);
    hashes[whole ? 0 : 1] = saved(viewer);

    const Result<LoadedFile> own = load_file(viewer, scene, {}, whole ? 1000 : 0);
    ASSERT_TRUE(own) << own.error().to_string();
    EXPECT_EQ(own->frames, nullptr);
    EXPECT_EQ(own->facts.format, "scene file");
    EXPECT_FALSE(load_file(viewer, path + ".not", {}, whole ? 1000 : 0));
    EXPECT_EQ(viewer.facts().spheres, 1);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bihive
