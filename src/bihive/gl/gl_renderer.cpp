#include "bihive/gl/gl_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/timer.h"
#include "bihive/gl/film_textures.h"
#include "bihive/gl/scene_on_gpu.h"
#include "bihive/gl/tile_walk.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/sample_pattern.h"

namespace bihive {
namespace {

// One draw takes this share of the budget, and always much less time than drivers allow for one draw.
constexpr double kShareOfBudget = 0.25;
constexpr double kLongestDrawMs = 50;
constexpr int kRowsAtOnce = 64;

std::string text_of(const GlFunctions& gl, GLenum name) {
  const GLubyte* const text = gl.GetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

class GlRenderer::Implementation {
 public:
  explicit Implementation(const GlFunctions& functions) : gl_(functions), film_(gl_), scene_(gl_) {}
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    if (abandoned_) return;
    scene_.destroy();
    film_.destroy();
    if (shower_) shower_->destroy();
    if (vertices_ != 0) gl_.DeleteVertexArrays(1, &vertices_);
  }

  Status start() {
    GLint version = 0;
    gl_.GetIntegerv(GL_MAJOR_VERSION, &version);
    if (version < 3)
      return Error{"OpenGL ES 3.0 or OpenGL 3.3 is needed, found " + text_of(gl_, GL_VERSION), "", 0, 0,
                   "choose an engine of the CPU"};
    description_ = text_of(gl_, GL_VENDOR) + ", " + text_of(gl_, GL_RENDERER) + ", " + text_of(gl_, GL_VERSION);
    gl_.GenVertexArrays(1, &vertices_);
    if (Status status = film_.choose_format(); !status) return status;
    scene_.set_film_of_bits(film_.of_bits());
    Result<GlProgram> shower = GlProgram::link(
        gl_, "show", film_.of_bits() ? std::vector<std::string>{"FILM_OF_BITS"} : std::vector<std::string>{});
    if (!shower) return shower.error();
    shower_ = std::move(*shower);
    return Done{};
  }

  Status set_scene(const Scene& scene, const Tree* tree) {
    if (has_clips(scene))
      return Error{"the graphics processor draws no cut spheres", "", 0, 0, "choose an engine of the CPU"};
    Status status = scene_.set(scene, tree);
    if (status) program_ = nullptr;
    return status;
  }

  Status set_lights(const Scene& scene) {
    BIHIVE_CHECK(scene_.is_set());
    program_ = nullptr;
    return scene_.set_lights(scene);
  }

  Status begin(const Camera& camera, const RenderSettings& settings) {
    BIHIVE_CHECK(scene_.is_set());
    program_ = nullptr;
    if (settings.view == View::tree)
      return Error{"the tree view is drawn by the CPU alone", "", 0, 0, "choose the reference engine"};
    if (settings.view == View::traversal && !scene_.has_tree())
      return Error{"this view shows the reference tree, which the engine does not have", "", 0, 0,
                   "choose an engine with a tree"};
    if (settings.crop)
      return Error{"the graphics processor draws no part of a picture", "", 0, 0, "choose an engine of the CPU"};
    if (settings.transparent)
      return Error{"the graphics processor draws no transparent background", "", 0, 0, "choose an engine of the CPU"};
    GLint largest = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(settings.width_px, settings.height_px) > largest)
      return Error{"the graphics processor draws at most " + std::to_string(largest) + " pixels a side", "", 0, 0,
                   "draw a smaller picture"};
    const Result<CameraUniforms> at =
        CameraUniforms::from(camera, scene_.scale(), settings.width_px, settings.height_px);
    if (!at) return at.error();
    camera_ = *at;
    settings_ = settings;

    // The distance view first needs the range of distances.
    finding_range_ = settings.view == View::distance;
    Result<GlProgram*> program = scene_.program_for(settings.view, settings.recursion);
    if (program && finding_range_) program = scene_.program_for_distance_range();
    if (!program) return program.error();
    if (Status status = film_.resize(settings.width_px, settings.height_px); !status) return status;
    program_ = *program;
    start_passes();
    return Done{};
  }

  Status advance(double budget_ms) {
    BIHIVE_CHECK(program_ != nullptr);
    const Timer timer;
    double last_ms = 0;
    bool first = true;
    take_state();
    while (!finished() && (first || timer.elapsed_ms() + last_ms <= budget_ms)) {
      if (first || walk_.at_start()) put_uniforms();
      first = false;
      const Timer draw;
      const Tile tile = walk_.next(std::clamp(kShareOfBudget * budget_ms, 1.0, kLongestDrawMs));
      gl_.Scissor(tile.x0, tile.y0, tile.x1 - tile.x0, tile.y1 - tile.y0);
      gl_.DrawArrays(GL_TRIANGLES, 0, 3);
      film_.wait(target());
      last_ms = draw.elapsed_ms();
      walk_.took(last_ms);
      if (!walk_.at_end()) continue;
      if (Status status = end_pass(); !status) return status;
    }
    give_state_back();
    if (gl_.GetError() == GL_NO_ERROR) return Done{};
    return Error{"the graphics processor has stopped drawing: its context is lost, or its memory is used up", "", 0, 0,
                 "choose an engine of the CPU"};
  }

  bool finished() const { return !finding_range_ && pass_ == settings_.samples_per_pixel; }
  int samples_done() const { return finding_range_ ? 0 : pass_; }

  double done() const {
    if (finished()) return 1;
    const double samples = settings_.samples_per_pixel;
    const double passes = pass_ + walk_.done();
    if (settings_.view != View::distance) return passes / samples;
    return (finding_range_ ? passes : samples + passes) / (2 * samples);
  }

  void show(std::uint32_t framebuffer, const GlViewport& viewport, Transfer transfer) {
    take_state();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.Viewport(viewport.x, viewport.y, viewport.width, viewport.height);
    gl_.Scissor(viewport.x, viewport.y, viewport.width, viewport.height);
    shower_->use();
    gl_.BindTexture(GL_TEXTURE_2D, film_.texture(pass_ > 0 ? (pass_ - 1) % 2 : 0));
    shower_->set("film", 0);
    shower_->set("film_size", float(film_.width()), float(film_.height()));
    shower_->set("corner", float(viewport.x), float(viewport.y));
    shower_->set("size", float(viewport.width), float(viewport.height));
    shower_->set("samples", float(std::max(pass_, 1)));
    shower_->set("srgb", settings_.view == View::shaded && transfer == Transfer::srgb);
    shower_->set("only_background", finding_range_);
    shower_->set("background", scene_.background());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    give_state_back();
  }

  Result<Picture> read() {
    BIHIVE_CHECK(finished());
    Picture picture;
    const int width = settings_.width_px;
    picture.film = Film(width, settings_.height_px);
    picture.primary = std::int64_t{width} * settings_.height_px * settings_.samples_per_pixel;
    const auto samples = static_cast<float>(settings_.samples_per_pixel);
    double others = 0;
    for_each_row([&](int y, const float* row) {
      for (int x = 0; x < width; ++x, row += 4) {
        picture.film.at(x, y) = {row[0] / samples, row[1] / samples, row[2] / samples};
        others += double(row[3]);
      }
    });
    picture.others = static_cast<std::int64_t>(std::llround(others));
    if (gl_.GetError() != GL_NO_ERROR) return Error{"the graphics processor gave no picture", "", 0, 0, ""};
    return picture;
  }

  const std::string& description() const { return description_; }
  void abandon() { abandoned_ = true; }
  bool has_picture() const { return program_ != nullptr; }

 private:
  // The film's texture that the pass draws into; the other is that of the pass before.
  int target() const { return pass_ % 2; }

  void start_passes() {
    pass_ = 0;
    walk_.restart(settings_.width_px, settings_.height_px);
    take_state();
    if (!finding_range_) film_.fill(0, scene_.background());
    give_state_back();
  }

  // The next pass, or the picture after the range of distances.
  Status end_pass() {
    ++pass_;
    walk_.restart(settings_.width_px, settings_.height_px);
    if (!finding_range_ || pass_ < settings_.samples_per_pixel) return Done{};
    nearest_ = std::numeric_limits<float>::max();
    farthest_ = -nearest_;
    for_each_row([&](int, const float* row) {
      for (int x = 0; x < settings_.width_px; ++x, row += 4) {
        nearest_ = std::min(nearest_, row[0]);
        farthest_ = std::max(farthest_, row[1]);
      }
    });
    finding_range_ = false;
    const Result<GlProgram*> program = scene_.program_for(settings_.view, settings_.recursion);
    if (!program) return program.error();
    program_ = *program;
    start_passes();
    take_state();
    return Done{};
  }

  // Every row of the last complete pass.
  template <class Use>
  void for_each_row(const Use& use) {
    std::vector<float> rows;
    for (int y0 = 0; y0 < settings_.height_px; y0 += kRowsAtOnce) {
      const int y1 = std::min(y0 + kRowsAtOnce, settings_.height_px);
      film_.read((pass_ - 1) % 2, y0, y1, rows);
      for (int y = y0; y < y1; ++y)
        use(y, rows.data() + 4 * static_cast<std::size_t>(settings_.width_px) * static_cast<std::size_t>(y - y0));
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  }

  void put_uniforms() {
    program_->use();
    scene_.put(*program_);
    camera_.put(*program_);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, film_.texture(1 - target()));
    program_->set("film_before", 0);
    program_->set("sample_index", pass_);
    const SamplePlace place = sample_place(pass_, settings_.samples_per_pixel);
    program_->set("sample_place", float(place.x), float(place.y));
    program_->set("recursion", settings_.recursion);
    program_->set("shadows", settings_.shadows);
    program_->set("view", settings_.view == View::normal ? 0 : settings_.view == View::distance ? 1 : 2);
    program_->set("nearest", nearest_);
    program_->set("farthest", farthest_);
    film_.draw_into(target());
    gl_.Enable(GL_SCISSOR_TEST);
  }

  // Other code that uses the context may have left any state.
  void take_state() {
    gl_.BindVertexArray(vertices_);
    for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_DITHER, GL_STENCIL_TEST}) gl_.Disable(off);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.ActiveTexture(GL_TEXTURE0);
  }
  void give_state_back() {
    gl_.BindVertexArray(0);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl_.UseProgram(0);
    gl_.Disable(GL_SCISSOR_TEST);
  }

  GlFunctions gl_;
  FilmTextures film_;
  SceneOnGpu scene_;
  std::optional<GlProgram> shower_;
  GLuint vertices_ = 0;
  std::string description_;
  bool abandoned_ = false;

  // The unfinished picture.
  RenderSettings settings_;
  CameraUniforms camera_;
  GlProgram* program_ = nullptr;  // null: no picture was begun
  TileWalk walk_;
  int pass_ = 0;  // complete passes, of the picture or of its range of distances
  bool finding_range_ = false;
  float nearest_ = 0, farthest_ = 0;
};

Result<GlRenderer> GlRenderer::create(const GlFunctions& functions) {
  auto made = std::make_unique<Implementation>(functions);
  if (const Status status = made->start(); !status) return status.error();
  return GlRenderer(std::move(made));
}

GlRenderer::GlRenderer(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
GlRenderer::GlRenderer(GlRenderer&& other) noexcept = default;
GlRenderer& GlRenderer::operator=(GlRenderer&& other) noexcept = default;
GlRenderer::~GlRenderer() = default;

Status GlRenderer::set_scene(const Scene& scene, const Tree* tree) {
  return implementation_->set_scene(scene, tree);
}
Status GlRenderer::set_lights(const Scene& scene) {
  return implementation_->set_lights(scene);
}
Status GlRenderer::begin(const Camera& camera, const RenderSettings& settings) {
  return implementation_->begin(camera, settings);
}
Status GlRenderer::advance(double budget_ms) {
  return implementation_->advance(budget_ms);
}
bool GlRenderer::finished() const {
  return implementation_->has_picture() && implementation_->finished();
}
double GlRenderer::done() const {
  return implementation_->has_picture() ? implementation_->done() : 0;
}
int GlRenderer::samples_done() const {
  return implementation_->has_picture() ? implementation_->samples_done() : 0;
}
void GlRenderer::show(std::uint32_t framebuffer, const GlViewport& viewport, Transfer transfer) {
  if (implementation_->has_picture()) implementation_->show(framebuffer, viewport, transfer);
}
Result<GlRenderer::Picture> GlRenderer::read() {
  return implementation_->read();
}
std::string GlRenderer::description() const {
  return implementation_->description();
}
void GlRenderer::abandon() {
  implementation_->abandon();
}

}  // namespace bihive
