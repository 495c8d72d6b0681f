// The rest of the renderer's contract: errors, progress, the shown picture, and drivers' messages.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bihive/bih/reference_builder.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/gl/program.h"
#include "bihive/scene/generators.h"
#include "support/gl_picture.h"

namespace bihive {
namespace {

using test::GlPictures;

RenderSettings small() {
  RenderSettings settings;
  settings.width_px = 64;
  settings.height_px = 48;
  settings.samples_per_pixel = 1;
  return settings;
}

// A picture of 8 bits, drawn by show().
class Screen {
 public:
  Screen(const GlFunctions& gl, int width, int height) : gl_(gl), width_(width), height_(height) {
    gl_.GenTextures(1, &texture_);
    gl_.BindTexture(GL_TEXTURE_2D, texture_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl_.GenFramebuffers(1, &framebuffer_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    gl_.ClearColor(1, 0, 1, 1);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
  }
  ~Screen() {
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteTextures(1, &texture_);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  std::uint32_t framebuffer() const { return framebuffer_; }
  // Rows from below, in OpenGL's order.
  std::array<int, 3> at(int x, int y) {
    std::vector<std::uint8_t> rgba(4 * std::size_t(width_) * std::size_t(height_));
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    const std::size_t i = 4 * (std::size_t(y) * std::size_t(width_) + std::size_t(x));
    return {rgba[i], rgba[i + 1], rgba[i + 2]};
  }

 private:
  const GlFunctions& gl_;
  int width_, height_;
  GLuint texture_ = 0, framebuffer_ = 0;
};

TEST(GlRenderer, a_tile_at_a_time) {
  GlRenderer& renderer = GlPictures::get().renderer();
  const Scene scene = four_spheres_scene();
  const Tree tree = build_reference_tree(scene.spheres, {});
  ASSERT_TRUE(renderer.set_scene(scene, &tree).ok());
  EXPECT_FALSE(renderer.finished());
  RenderSettings settings = small();
  settings.width_px = 256;
  settings.height_px = 256;
  settings.samples_per_pixel = 2;
  ASSERT_TRUE(renderer.begin(scene.camera, settings).ok());
  double before = 0;
  int steps = 0;
  while (!renderer.finished()) {
    ASSERT_TRUE(renderer.advance(0).ok());
    EXPECT_GT(renderer.done(), before);
    before = renderer.done();
    EXPECT_EQ(renderer.samples_done(), static_cast<int>(std::floor(2 * before)));
    ++steps;
  }
  EXPECT_GT(steps, 4);
  EXPECT_EQ(renderer.done(), 1);
  EXPECT_EQ(renderer.read()->primary, 2 * 256 * 256);
}

TEST(GlRenderer, views_that_it_does_not_have) {
  GlRenderer& renderer = GlPictures::get().renderer();
  const Scene scene = four_spheres_scene();
  ASSERT_TRUE(renderer.set_scene(scene, nullptr).ok());
  RenderSettings settings = small();
  settings.view = View::tree;
  EXPECT_FALSE(renderer.begin(scene.camera, settings).ok());
  settings.view = View::traversal;
  EXPECT_FALSE(renderer.begin(scene.camera, settings).ok());
  settings = small();
  settings.cell_lines.emplace();
  const Status edges = renderer.begin(scene.camera, settings);
  ASSERT_FALSE(edges.ok());
  EXPECT_EQ(edges.error().message, "the graphics processor draws no edges of a cell");
  Camera camera;
  camera.look_at = camera.eye;
  EXPECT_FALSE(renderer.begin(camera, small()).ok());
  camera = scene.camera;
  camera.eye.z = 1e30;
  const Status far = renderer.begin(camera, small());
  ASSERT_FALSE(far.ok());
  EXPECT_NE(far.error().message.find("too far away"), std::string::npos);
  settings = small();
  settings.width_px = 65535;
  EXPECT_FALSE(renderer.begin(scene.camera, settings).ok());
}

// A context whose textures have few rows, on request.
GLint g_most_rows = 0;
void GL_APIENTRY few_rows(GLenum name, GLint* value) {
  GlPictures::get().functions().GetIntegerv(name, value);
  if (name == GL_MAX_TEXTURE_SIZE && g_most_rows > 0) *value = g_most_rows;
}

TEST(GlRenderer, a_scene_that_is_refused_leaves_the_one_before) {
  GlFunctions functions = GlPictures::get().functions();
  functions.GetIntegerv = few_rows;
  GlRenderer renderer = GlPictures::must(GlRenderer::create(functions));
  const auto draw = [&](const Camera& camera) {
    EXPECT_TRUE(renderer.begin(camera, small()).ok());
    while (!renderer.finished()) EXPECT_TRUE(renderer.advance(1000).ok());
    return renderer.read()->film;
  };
  const Scene scene = four_spheres_scene();
  ASSERT_TRUE(renderer.set_scene(scene, nullptr).ok());
  const Film before = draw(scene.camera);

  g_most_rows = 2;
  Scene dazzling = scene;
  dazzling.background = {1, 0, 0};
  dazzling.lights.resize(2049);
  const Status refused = renderer.set_scene(dazzling, nullptr);
  g_most_rows = 0;
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "2049 lights are too many for this graphics processor, whose textures hold 2048");
  const Film after = draw(scene.camera);
  for (std::size_t i = 0; i < before.radiance.size(); ++i) ASSERT_EQ(before.radiance[i], after.radiance[i]);
}

// A context that draws into no texture of floating point, on request.
GLint g_last_format = 0;
void GL_APIENTRY remembering_format(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height,
                                    GLint border, GLenum layout, GLenum type, const void* texels) {
  g_last_format = format;
  GlPictures::get().functions().TexImage2D(target, level, format, width, height, border, layout, type, texels);
}
GLenum GL_APIENTRY no_floats(GLenum target) {
  const bool of_floats = g_last_format == GL_RGBA32F || g_last_format == GL_RGBA16F;
  return of_floats ? GL_FRAMEBUFFER_UNSUPPORTED : GlPictures::get().functions().CheckFramebufferStatus(target);
}
GLenum GL_APIENTRY nothing_at_all(GLenum) {
  return GL_FRAMEBUFFER_UNSUPPORTED;
}

TEST(GlRenderer, draws_the_same_bits_without_textures_of_floating_point) {
  GlFunctions functions = GlPictures::get().functions();
  functions.TexImage2D = remembering_format;
  functions.CheckFramebufferStatus = no_floats;
  GlRenderer of_bits = GlPictures::must(GlRenderer::create(functions));
  EXPECT_EQ(g_last_format, GL_RGBA32UI);
  GlRenderer& of_numbers = GlPictures::get().renderer();
  Scene scene = scenario_scene(Scenario::mixed, {200, 1, 1}).value();
  scene.background = {0.5, 0.25, 0};
  const Tree tree = build_reference_tree(scene.spheres, {});
  RenderSettings settings = small();
  settings.samples_per_pixel = 3;
  settings.recursion = 5;
  // Once more with everything: slices, first hits, layers and coverage have textures of their own.
  const std::vector<std::pair<View, bool>> both{
      {View::shaded, false},   {View::recursion, false}, {View::traversal, false}, {View::normal, false},
      {View::distance, false}, {View::id, false},        {View::shaded, true}};
  for (const auto& [view, everything] : both) {
    SCOPED_TRACE(static_cast<int>(view));
    settings.view = view;
    if (everything) {
      settings.ambient_occlusion = AmbientOcclusion{1, 200};
      settings.opacity_rule = OpacityRule::once;
      settings.outline.emplace();
      settings.transparent = true;
      settings.shadows = true;
      scene.lights[0].radius = 1;
    }
    std::vector<GlRenderer::Picture> pictures;
    std::vector<std::array<int, 3>> shown[2];
    for (GlRenderer* renderer : {&of_numbers, &of_bits}) {
      ASSERT_TRUE(renderer->set_scene(scene, &tree).ok());
      ASSERT_TRUE(renderer->begin(scene.camera, settings).ok());
      Screen screen(functions, 64, 48);
      const auto look = [&] {
        renderer->show(screen.framebuffer(), {0, 0, 64, 48}, Transfer::srgb);
        for (int x = 0; x < 64; ++x) shown[pictures.size()].push_back(screen.at(x, x % 48));
      };
      look();  // the background
      while (!renderer->finished()) ASSERT_TRUE(renderer->advance(1000).ok());
      look();
      pictures.push_back(GlPictures::must(renderer->read()));
    }
    EXPECT_EQ(shown[0], shown[1]);
    EXPECT_EQ(pictures[0].others, pictures[1].others);
    for (std::size_t i = 0; i < pictures[0].film.radiance.size(); ++i)
      ASSERT_EQ(pictures[0].film.radiance[i], pictures[1].film.radiance[i]);
  }

  functions.CheckFramebufferStatus = nothing_at_all;
  const Result<GlRenderer> none = GlRenderer::create(functions);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("128 bits"), std::string::npos);
}

TEST(GlRenderer, shows_the_background_then_the_picture) {
  GlRenderer& renderer = GlPictures::get().renderer();
  Scene scene = four_spheres_scene();
  scene.background = {0.5, 0.25, 0};
  const RenderSettings settings = small();
  ASSERT_TRUE(renderer.set_scene(scene, nullptr).ok());
  ASSERT_TRUE(renderer.begin(scene.camera, settings).ok());
  Screen screen(GlPictures::get().functions(), 80, 60);
  const GlViewport viewport{8, 6, 64, 48};
  renderer.show(screen.framebuffer(), viewport, Transfer::none);
  EXPECT_EQ(screen.at(8, 6), (std::array{128, 64, 0}));
  EXPECT_EQ(screen.at(71, 53), (std::array{128, 64, 0}));
  EXPECT_EQ(screen.at(7, 6), (std::array{255, 0, 255}));  // outside of the viewport nothing changes
  EXPECT_EQ(screen.at(72, 53), (std::array{255, 0, 255}));
  renderer.show(screen.framebuffer(), viewport, Transfer::srgb);
  EXPECT_EQ(screen.at(8, 6), (std::array{188, 137, 0}));

  while (!renderer.finished()) ASSERT_TRUE(renderer.advance(1000).ok());
  const Film film = renderer.read()->film;
  for (const Transfer transfer : {Transfer::none, Transfer::srgb}) {
    renderer.show(screen.framebuffer(), viewport, transfer);
    for (const int y : {0, 10, 24, 40, 47})
      for (int x = 0; x < 64; x += 3) {
        const Vec3f wanted = film.at(x, 47 - y);
        const std::array<int, 3> got = screen.at(8 + x, 6 + y);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(got[std::size_t(k)], byte_from_radiance(double(wanted[k]), transfer), 1);
      }
  }
}

TEST(GlRenderer, shows_the_background_while_distances_are_sought) {
  GlRenderer& renderer = GlPictures::get().renderer();
  Scene scene = four_spheres_scene();
  scene.background = {0, 1, 0};
  RenderSettings settings = small();
  settings.view = View::distance;
  ASSERT_TRUE(renderer.set_scene(scene, nullptr).ok());
  ASSERT_TRUE(renderer.begin(scene.camera, settings).ok());
  ASSERT_TRUE(renderer.advance(0).ok());
  ASSERT_LT(renderer.done(), 0.5);
  Screen screen(GlPictures::get().functions(), 64, 48);
  renderer.show(screen.framebuffer(), {0, 0, 64, 48}, Transfer::none);
  for (int i = 0; i < 48; ++i) EXPECT_EQ(screen.at(i, i), (std::array{0, 255, 0}));
}

TEST(GlProgram, a_refused_shader_names_chunk_and_line) {
  // Without the size of its stack the integrator does not compile.
  GlPictures::get();
  const Result<GlProgram> program = GlProgram::link(GlPictures::get().functions(), "view_shaded", {});
  ASSERT_FALSE(program.ok());
  EXPECT_NE(program.error().message.find("integrator.glsl:26"), std::string::npos) << program.error().message;
  EXPECT_NE(program.error().message.find("PENDING_RAYS"), std::string::npos) << program.error().message;
  EXPECT_EQ(program.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace bihive
