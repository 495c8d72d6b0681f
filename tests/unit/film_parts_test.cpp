// The parts of a film that are pure: ranges of frames, moving cameras, titles.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/scene/camera_path.h"
#include "bihive/scene/frame_range.h"
#include "bihive/scene/title_text.h"

namespace bihive {
namespace {

std::vector<std::int64_t> frames_of(const std::string& text, std::int64_t frames) {
  const FrameList list = frames_in(frame_range_from_text(text).value(), frames).value();
  std::vector<std::int64_t> numbers;
  for (std::int64_t k = 0; k < list.count; ++k) numbers.push_back(list.frame(k));
  return numbers;
}

using Numbers = std::vector<std::int64_t>;

TEST(FrameRange, IsThatOfTheText) {
  EXPECT_EQ(frames_of("0:10:3", 100), (Numbers{0, 3, 6, 9}));
  EXPECT_EQ(frames_of("0:9:3", 100), (Numbers{0, 3, 6}));
  EXPECT_EQ(frames_of("2:4", 100), (Numbers{2, 3}));
  EXPECT_EQ(frames_of("::2", 5), (Numbers{0, 2, 4}));
  EXPECT_EQ(frames_of(":", 2), (Numbers{0, 1}));
  EXPECT_EQ(frames_of("3", 5), (Numbers{3}));
  EXPECT_EQ(frames_of("-1", 5), (Numbers{4}));
  EXPECT_EQ(frames_of("-2", 5), (Numbers{3}));
  EXPECT_EQ(frames_of("-3:-1", 5), (Numbers{2, 3}));
  EXPECT_EQ(frames_of("3:1000", 5), (Numbers{3, 4}));
}

TEST(FrameRange, RefusesOtherTexts) {
  for (const char* text : {"", "a", "1:2:3:4", "1:2:0", "1:2:-1", "1.5", "1: 2", "-", "--1", "99999999999999999999"})
    EXPECT_FALSE(frame_range_from_text(text).ok()) << text;
}

TEST(FrameRange, RefusesFramesThatAreNotThere) {
  for (const char* text : {"5", "5:", "3:3", "4:2", "-6", "-6:"})
    EXPECT_FALSE(frames_in(frame_range_from_text(text).value(), 5).ok()) << text;
  EXPECT_NE(frames_in(frame_range_from_text("7").value(), 5).error().message.find("5 frames, 0 to 4"),
            std::string::npos);
}

TEST(FrameRange, KnowsThePictureOfAFrame) {
  const FrameList list{2, 3, 4};  // 2, 5, 8, 11
  EXPECT_EQ(list.picture_of(2), 0);
  EXPECT_EQ(list.picture_of(11), 3);
  for (const std::int64_t frame : {0, 1, 3, 4, 12, 14}) EXPECT_FALSE(list.picture_of(frame).has_value()) << frame;
}

Camera camera_on_z() {
  Camera camera;
  camera.eye = {1, 2, 13};
  camera.look_at = {1, 2, 3};
  return camera;
}

TEST(CameraPath, WithoutMovementIsTheCameraItself) {
  EXPECT_TRUE(camera_at({}, camera_on_z(), 3, 10) == camera_on_z());
}

TEST(CameraPath, TurntableGoesRoundByEqualAngles) {
  CameraPath path;
  path.turntable_deg = 360;
  const Camera base = camera_on_z();
  const Vec3d eyes[] = {{1, 2, 13}, {11, 2, 3}, {1, 2, -7}, {-9, 2, 3}};
  for (int k = 0; k < 4; ++k) {
    const Camera camera = camera_at(path, base, k, 4);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(camera.eye[axis], eyes[k][axis], 1e-12) << k;
    EXPECT_EQ(camera.look_at, base.look_at);
  }
}

CameraKey key(std::int64_t picture, double azimuth) {
  CameraKey made;
  made.picture = picture;
  made.turn = Turn{azimuth, 0, 0};
  return made;
}

// The angle of the eye around y, from +z towards +x.
double azimuth_of(const Camera& camera) {
  return std::atan2(camera.eye.x - camera.look_at.x, camera.eye.z - camera.look_at.z) * 180 / std::acos(-1.0);
}

TEST(CameraPath, PassesThroughItsKeysAndNeverOvershoots) {
  CameraPath path;
  path.keys = {key(10, 0), key(20, 80), key(60, 90), key(70, 90)};
  EXPECT_NEAR(azimuth_of(camera_at(path, camera_on_z(), 0, 100)), 0, 1e-9);
  EXPECT_NEAR(azimuth_of(camera_at(path, camera_on_z(), 20, 100)), 80, 1e-9);
  EXPECT_NEAR(azimuth_of(camera_at(path, camera_on_z(), 99, 100)), 90, 1e-9);
  double before = -1;
  for (int k = 10; k <= 70; ++k) {
    const double angle = azimuth_of(camera_at(path, camera_on_z(), k, 100));
    EXPECT_GE(angle, before - 1e-9) << k;
    EXPECT_LE(angle, 90 + 1e-9) << k;
    before = angle;
  }
}

TEST(CameraPath, IsSmoothAndBeginsAndEndsAtRest) {
  CameraPath path;
  path.keys = {key(0, 0), key(50, 60), key(100, 120)};
  const auto step = [&](int k) {
    return azimuth_of(camera_at(path, camera_on_z(), k + 1, 101)) - azimuth_of(camera_at(path, camera_on_z(), k, 101));
  };
  EXPECT_LT(step(0), 0.1);
  EXPECT_LT(step(99), 0.1);
  // The middle key is passed at full speed, and no step differs much from the next.
  EXPECT_GT(step(50), 1);
  for (int k = 0; k < 99; ++k) EXPECT_NEAR(step(k), step(k + 1), 0.12) << k;
}

TEST(CameraPath, MovesZoomAndPlaceOnTheirOwn) {
  CameraPath path;
  CameraKey zoom;
  zoom.picture = 0;
  zoom.zoom = 2;
  CameraKey place;
  place.picture = 10;
  place.look_at = Vec3d{5, 5, 5};
  path.keys = {zoom, place};
  const Camera camera = camera_at(path, camera_on_z(), 4, 11);
  EXPECT_EQ(camera.look_at, (Vec3d{5, 5, 5}));
  EXPECT_EQ(camera.eye, (Vec3d{5, 5, 15}));
  EXPECT_LT(camera.fov_deg, 16);
}

TEST(CameraPath, KeysGoThroughJson) {
  const std::string text =
      R"({"keys": [{"picture": 0, "turn": [0, 10, -5.5]}, {"picture": 7, "zoom": 0.1, "look_at": [1e-3, 2, 3]}]})";
  const std::vector<CameraKey> keys = parse_camera_keys(text, "k.json").value();
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].turn->roll, -5.5);
  EXPECT_FALSE(keys[0].zoom.has_value());
  EXPECT_EQ(keys[1].picture, 7);
  const std::string again = camera_keys_to_json(keys);
  EXPECT_EQ(camera_keys_to_json(parse_camera_keys(again, "k.json").value()), again);
}

TEST(CameraPath, BadKeysAreRefusedWithTheirPlace) {
  const std::pair<const char*, const char*> bad[] = {
      {"[]", "/: expected an object"},
      {R"({"keys": []})", "/keys: expected a list"},
      {R"({"keys": [{}], "more": 1})", "/: expected \"keys\" alone"},
      {R"({"keys": [{"zoom": 1}]})", "/keys/0: expected the word \"picture\""},
      {R"({"keys": [{"picture": -1}]})", "/keys/0/picture: expected a whole number"},
      {R"({"keys": [{"picture": 0.5}]})", "/keys/0/picture"},
      {R"({"keys": [{"picture": 1}, {"picture": 1}]})", "/keys/1/picture: expected a picture after"},
      {R"({"keys": [{"picture": 0, "turn": [1, 2]}]})", "/keys/0/turn: expected [azimuth"},
      {R"({"keys": [{"picture": 0, "turn": [1, 2, 1e9]}]})", "/keys/0/turn"},
      {R"({"keys": [{"picture": 0, "eye": [1, 2, 3]}]})", "/keys/0: expected picture, turn, zoom or look_at"},
  };
  for (const auto& [text, message] : bad) {
    const Result<std::vector<CameraKey>> keys = parse_camera_keys(text, "k.json");
    ASSERT_FALSE(keys.ok()) << text;
    EXPECT_EQ(keys.error().message.rfind(message, 0), 0U) << keys.error().message;
    EXPECT_EQ(keys.error().file, "k.json");
  }
}

TEST(Title, TakesValues) {
  const TitleValues values{{"time", 12.5}, {"frame", 7}, {"step", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(fill_title("t = {time} ps, {frame}", values).value(), "t = 12.5 ps, 7");
  EXPECT_EQ(fill_title("{time:.3f} {frame:.0f}", values).value(), "12.500 7");
  EXPECT_EQ(fill_title("{{time}} }}", values).value(), "{time} }");
  EXPECT_EQ(fill_title("Ångström", values).value(), "Ångström");
  EXPECT_EQ(fill_title("{n}", {{"n", 123456789}}).value(), "123456789");
  for (const char* text : {"{step}", "{tme}", "{time", "time}", "{}", "{time:}", "{time:.12f}", "{time:d}"})
    EXPECT_FALSE(fill_title(text, values).ok()) << text;
}

}  // namespace
}  // namespace bihive
