// The model behind window and page, with the graphics processor.
#include "bihive/viewer/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "bihive/image/image_diff.h"
#include "support/gl_picture.h"

namespace bihive {
namespace {

using testing::HasSubstr;

constexpr int kViewerWidth = 120, kViewerHeight = 80;

const GlFunctions& gl() {
  return test::GlPictures::get().functions();
}

void settle(Viewer& viewer) {
  for (int i = 0; i < 100000; ++i) {
    const Result<FrameReport> report = viewer.frame(20);
    ASSERT_TRUE(report) << report.error().to_string();
    if (report->settled) return;
  }
  FAIL() << "never settled";
}

void choose(Viewer& viewer, ViewerEngine engine) {
  ViewerSettings settings = viewer.settings();
  settings.engine = engine;
  const Status status = viewer.set(settings);
  ASSERT_TRUE(status) << status.error().to_string();
}

void choose_plain(Viewer& viewer) {
  ViewerLook look;
  look.style = "plain";
  ASSERT_TRUE(viewer.set_look(look));
}

// The output of show() in a framebuffer as large as the picture.
Image shown(Viewer& viewer, int width = kViewerWidth, int height = kViewerHeight) {
  GLuint texture = 0, framebuffer = 0;
  gl().GenTextures(1, &texture);
  gl().BindTexture(GL_TEXTURE_2D, texture);
  gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl().GenFramebuffers(1, &framebuffer);
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  gl().ClearColor(1, 0, 1, 1);
  gl().Clear(GL_COLOR_BUFFER_BIT);
  viewer.show(framebuffer, {0, 0, width, height});
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  std::vector<std::uint8_t> rgba(std::size_t(4) * std::size_t(width) * std::size_t(height));
  gl().ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  EXPECT_EQ(gl().GetError(), GLenum(GL_NO_ERROR));
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl().DeleteFramebuffers(1, &framebuffer);
  gl().DeleteTextures(1, &texture);
  Image image{width, height, {}};
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.rgb.push_back(rgba[std::size_t(4 * (y * width + x) + channel)]);
  return image;
}

// The share of pixels that differ by more than 2 in a channel.
double share_off(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  std::int64_t off = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    for (std::size_t channel = 0; channel < 3; ++channel)
      if (std::abs(int(a.rgb[i + channel]) - int(b.rgb[i + channel])) > 2) {
        ++off;
        break;
      }
  return static_cast<double>(off) / (a.width * a.height);
}

TEST(GpuViewer, settles_at_what_the_cpu_draws) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  EXPECT_FALSE(viewer.has_gl());
  ASSERT_TRUE(viewer.attach_gl(gl()));
  EXPECT_TRUE(viewer.has_gl());
  EXPECT_THAT(viewer.gl_description(), HasSubstr("OpenGL"));
  for (const char* name : {"demo", "scenario1"}) {
    ASSERT_TRUE(viewer.load_built_in(name));
    if (viewer.facts().takes_style) choose_plain(viewer);
    viewer.orbit(25, 10);
    choose(viewer, ViewerEngine::cpu);
    settle(viewer);
    const Image by_cpu = viewer.image();
    choose(viewer, ViewerEngine::gpu);
    settle(viewer);
    EXPECT_LE(share_off(shown(viewer), by_cpu), 0.005) << name;
    EXPECT_GT(viewer.frame(20)->mray_per_s, 0);
  }
  for (const View view : {View::recursion, View::traversal, View::normal, View::distance, View::id}) {
    ViewerSettings settings = viewer.settings();
    settings.view = view;
    settings.engine = ViewerEngine::cpu;
    ASSERT_TRUE(viewer.set(settings));
    settle(viewer);
    const Image by_cpu = viewer.image();
    choose(viewer, ViewerEngine::gpu);
    settle(viewer);
    EXPECT_LE(share_off(shown(viewer), by_cpu), 0.005) << static_cast<int>(view);
  }
}

TEST(GpuViewer, moves_and_shows_the_last_picture_meanwhile) {
  Viewer viewer;
  viewer.resize(400, 300);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  choose_plain(viewer);
  choose(viewer, ViewerEngine::gpu);
  settle(viewer);
  const Image before = shown(viewer, 400, 300);

  // A new picture is shown only when it is complete, and then it is coarser.
  viewer.orbit(60, 0);
  Result<FrameReport> report = viewer.frame(1e-3);
  for (int i = 0; i < 1000 && report && !report->drawn; ++i) {
    EXPECT_EQ(picture_hash(shown(viewer, 400, 300)), picture_hash(before));
    report = viewer.frame(1e-3);
  }
  ASSERT_TRUE(report);
  EXPECT_GT(report->divisor, 1);
  EXPECT_GT(share_off(shown(viewer, 400, 300), before), 0.05);
  settle(viewer);
  viewer.home();
  settle(viewer);
  EXPECT_EQ(picture_hash(shown(viewer, 400, 300)), picture_hash(before));
}

TEST(GpuViewer, a_picture_to_be_saved_does_not_disturb) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  choose_plain(viewer);
  choose(viewer, ViewerEngine::gpu);
  settle(viewer);
  const Image before = shown(viewer);
  const Result<PngPixels> same =
      viewer.picture(kViewerWidth, kViewerHeight, viewer.settings().picture.result().samples_per_pixel);
  ASSERT_TRUE(same);
  EXPECT_LE(share_off({same->width, same->height, same->bytes}, before), 0.001);
  const Result<PngPixels> larger = viewer.picture(2 * kViewerWidth, 2 * kViewerHeight, 1);
  ASSERT_TRUE(larger);
  EXPECT_EQ(larger->width, 2 * kViewerWidth);
  EXPECT_EQ(picture_hash(shown(viewer)), picture_hash(before));
  viewer.orbit(30, 0);
  settle(viewer);
  EXPECT_GT(share_off(shown(viewer), before), 0.05);
}

TEST(GpuViewer, a_picture_to_be_saved_comes_in_steps_and_may_be_dropped) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  choose_plain(viewer);
  choose(viewer, ViewerEngine::gpu);
  settle(viewer);
  const Image before = shown(viewer);
  const Result<PngPixels> whole = viewer.picture(300, 200, 2);
  ASSERT_TRUE(whole);
  ASSERT_TRUE(viewer.begin_picture(300, 200, 2));
  for (double last = 0; last < 1;) {
    const Result<double> done = viewer.advance_picture(1e-3);
    ASSERT_TRUE(done) << done.error().to_string();
    ASSERT_GT(*done, last);
    last = *done;
  }
  const Result<PngPixels> in_steps = viewer.take_picture();
  ASSERT_TRUE(in_steps);
  EXPECT_EQ(picture_hash(*in_steps), picture_hash(*whole));

  ASSERT_TRUE(viewer.begin_picture(300, 200, 2));
  ASSERT_LT(*viewer.advance_picture(1e-3), 1);
  viewer.drop_picture();
  EXPECT_EQ(picture_hash(shown(viewer)), picture_hash(before));
  viewer.orbit(30, 0);
  settle(viewer);
  EXPECT_GT(share_off(shown(viewer), before), 0.05);
  ASSERT_TRUE(viewer.begin_picture(300, 200, 2));
  viewer.detach_gl(true);
  EXPECT_FALSE(viewer.advance_picture(1));
  settle(viewer);
}

TEST(GpuViewer, a_lost_context_comes_back) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("scenario3"));
  choose(viewer, ViewerEngine::gpu);
  settle(viewer);
  const Image before = shown(viewer);
  for (const bool lost : {true, false}) {
    viewer.orbit(20, 0);
    ASSERT_TRUE(viewer.frame(1));
    viewer.detach_gl(lost);
    EXPECT_FALSE(viewer.has_gl());
    EXPECT_EQ(viewer.settings().engine, ViewerEngine::cpu) << "the CPU goes on";
    settle(viewer);
    EXPECT_EQ(viewer.image().width, kViewerWidth);
    ViewerSettings settings = viewer.settings();
    settings.engine = ViewerEngine::gpu;
    EXPECT_THAT(viewer.set(settings).error().to_string(), HasSubstr("no graphics processor"));
    ASSERT_TRUE(viewer.attach_gl(gl()));
    choose(viewer, ViewerEngine::gpu);
    viewer.home();
    settle(viewer);
    EXPECT_EQ(picture_hash(shown(viewer)), picture_hash(before));
  }
}

// Both engines' pictures at rest, and as they are saved.
void expect_same_pictures(Viewer& viewer, const std::string& what) {
  SCOPED_TRACE(what);
  choose(viewer, ViewerEngine::cpu);
  settle(viewer);
  const Image by_cpu = viewer.image();
  const Result<PngPixels> cpu_file = viewer.picture(kViewerWidth, kViewerHeight, 2);
  choose(viewer, ViewerEngine::gpu);
  settle(viewer);
  EXPECT_LE(share_off(shown(viewer), by_cpu), 0.005);
  const Result<PngPixels> gpu_file = viewer.picture(kViewerWidth, kViewerHeight, 2);
  ASSERT_TRUE(cpu_file && gpu_file);
  ASSERT_EQ(gpu_file->channels, cpu_file->channels);
  std::int64_t apart = 0;
  for (std::size_t i = 0; i < cpu_file->bytes.size(); ++i)
    apart += std::abs(int(cpu_file->bytes[i]) - int(gpu_file->bytes[i])) > 2 ? 1 : 0;
  EXPECT_LE(static_cast<double>(apart), 0.005 * static_cast<double>(cpu_file->bytes.size()));
}

TEST(GpuViewer, draws_styles_and_looks) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("samples_per_pixel", 2);
  ASSERT_TRUE(viewer.set(settings));
  expect_same_pictures(viewer, "the style default");

  ViewerLook look;
  look.style = "xray";
  look.background = "none";
  look.rows = {{"chain A", "colour", "orange"}, {"water", "hide", ""}, {"chain B", "opacity", "0.2"}};
  ASSERT_TRUE(viewer.set_look(look));
  expect_same_pictures(viewer, "the style xray on a transparent background");
  EXPECT_EQ(viewer.look(), look);
  EXPECT_EQ(viewer.picture(kViewerWidth, kViewerHeight, 1)->channels, 4);

  // A change of the look while the graphics processor draws.
  ViewerLook other;
  other.style = "illustrative";
  other.rows = {{"chain A", "outline", "3"}};
  const Image before = shown(viewer);
  ASSERT_TRUE(viewer.set_look(other));
  settle(viewer);
  EXPECT_GT(share_off(shown(viewer), before), 0.05);
  expect_same_pictures(viewer, "the style illustrative");
}

TEST(GpuViewer, draws_lens_tone_and_labels) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  choose_plain(viewer);
  expect_same_pictures(viewer, "plain");
  const Image plain = shown(viewer);
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("exposure", 1);
  settings.picture.user.set("tone", 1);
  settings.picture.user.set("title", std::string("A title"));
  settings.picture.user.set("axes", true);
  settings.picture.user.set("legend", true);
  settings.camera.aperture = 3;
  settings.picture.user.set("samples_per_pixel", 4);
  ASSERT_TRUE(viewer.set(settings));
  expect_same_pictures(viewer, "with effects");
  EXPECT_GT(share_off(shown(viewer), plain), 0.05);
}

// Labels stay as they are while the picture under them is coarse.
TEST(GpuViewer, labels_are_sharp_in_coarse_pictures) {
  constexpr int kTallWidth = 400, kTallHeight = 800, kTitleHeight = 60;
  Viewer viewer;
  viewer.resize(kTallWidth, kTallHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  choose_plain(viewer);
  choose(viewer, ViewerEngine::gpu);
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("title", std::string("a title"));
  ASSERT_TRUE(viewer.set(settings));
  settle(viewer);
  const auto top = [&] {
    Image image = shown(viewer, kTallWidth, kTallHeight);
    image.height = kTitleHeight;
    image.rgb.resize(std::size_t{3} * kTallWidth * kTitleHeight);
    return image;
  };
  viewer.orbit(40, 0);
  Result<FrameReport> report = viewer.frame(1e-3);
  for (int i = 0; i < 1000 && report && !report->drawn; ++i) report = viewer.frame(1e-3);
  ASSERT_TRUE(report && report->drawn);
  EXPECT_GT(report->divisor, 1);
  const Image coarse = top();
  settle(viewer);
  EXPECT_EQ(share_off(top(), coarse), 0) << "above the molecule there is the title alone";
  settings = viewer.settings();
  settings.picture.user.reset("title");
  ASSERT_TRUE(viewer.set(settings));
  settle(viewer);
  EXPECT_GT(share_off(top(), coarse), 0.001) << "the title was there";
}

TEST(GpuViewer, cut_spheres_stay_with_the_cpu) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerLook look;
  look.rows = {{"", "clip", "plane:0,0,1,0"}};
  ASSERT_TRUE(viewer.set_look(look));
  ViewerSettings settings = viewer.settings();
  settings.engine = ViewerEngine::gpu;
  EXPECT_THAT(viewer.set(settings).error().to_string(), HasSubstr("no cut spheres"));
  EXPECT_EQ(viewer.settings().engine, ViewerEngine::cpu);
  ASSERT_TRUE(viewer.set_look({}));
  choose(viewer, ViewerEngine::gpu);
  EXPECT_FALSE(viewer.set_look(look)) << "the look before stays";
  EXPECT_TRUE(viewer.look().rows.empty());
  settle(viewer);
}

TEST(GpuViewer, refuses_what_it_cannot_draw_and_goes_on) {
  Viewer viewer;
  viewer.resize(kViewerWidth, kViewerHeight);
  ASSERT_TRUE(viewer.attach_gl(gl()));
  ASSERT_TRUE(viewer.load_built_in("scenario1"));
  choose(viewer, ViewerEngine::gpu);
  settle(viewer);
  const Image before = shown(viewer);
  ViewerSettings settings = viewer.settings();
  settings.view = View::tree;
  EXPECT_THAT(viewer.set(settings).error().to_string(), HasSubstr("tree"));
  EXPECT_FALSE(viewer.load("nonsense", "a.pdb"));
  EXPECT_TRUE(viewer.frame(20)->settled);
  EXPECT_EQ(picture_hash(shown(viewer)), picture_hash(before));

  // Another tree, the same picture.
  settings = viewer.settings();
  settings.max_prims = 1;
  ASSERT_TRUE(viewer.set(settings));
  settle(viewer);
  EXPECT_LE(share_off(shown(viewer), before), 0.001);
}

}  // namespace
}  // namespace bihive
