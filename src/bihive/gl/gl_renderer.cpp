#include "bihive/gl/gl_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/timer.h"
#include "bihive/gl/film_textures.h"
#include "bihive/gl/first_hits_texture.h"
#include "bihive/gl/light_slices.h"
#include "bihive/gl/sample_textures.h"
#include "bihive/gl/scene_on_gpu.h"
#include "bihive/gl/tile_walk.h"
#include "bihive/scene/clips.h"
#include "bihive/settings/parameter.h"

namespace bihive {
namespace {

// One draw takes this share of the budget, and always much less time than drivers allow for one draw.
constexpr double kShareOfBudget = 0.25;
constexpr double kLongestDrawMs = 50;
constexpr int kRowsAtOnce = 64;

// The textures of a program: the film, the first hits, directions and points of lights, then the scene's.
constexpr int kUnitOfFilm = 0, kUnitOfFirstHits = 6, kUnitOfSamples = 7, kUnitOfSlices = 9;

// Alpha above this: shaders/film.glsl says that the driver has stopped the loops of a pixel.
constexpr float kLoopsStopped = 1e11F;

// The cost of first hits, as a fraction of a sample's.
constexpr double kShareOfFirstHits = 0.1;

// Pixels with at least this many rays are drawn in small blocks, so that no draw takes long.
int block_for(int rays_of_pixel) {
  return rays_of_pixel <= 8 ? TileWalk::kBlockPx : 16;
}

std::string text_of(const GlFunctions& gl, GLenum name) {
  const GLubyte* const text = gl.GetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

class GlRenderer::Implementation {
 public:
  explicit Implementation(const GlFunctions& functions)
      : gl_(functions),
        film_(gl_),
        sample_film_(gl_),
        coverage_film_(gl_),
        first_hits_(gl_),
        samples_(gl_),
        scene_(gl_) {}
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    if (abandoned_) return;
    scene_.destroy();
    film_.destroy();
    sample_film_.destroy();
    coverage_film_.destroy();
    first_hits_.destroy();
    samples_.destroy();
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
    sample_film_.take_format(film_);
    coverage_film_.take_format(film_);
    // A sampler needs a texture of its kind.
    if (Status status = first_hits_.resize(1, 1); !status) return status;
    if (Status status = sample_film_.resize(1, 1); !status) return status;
    if (Status status = coverage_film_.resize(1, 1); !status) return status;
    if (Status status = probe_loops(); !status) return status;
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
    if (scene.cavity_walls != nullptr)
      return Error{"the graphics processor draws no walls of cavities", "", 0, 0, "choose an engine of the CPU"};
    if (scene.plane && scene.plane->shadows_only)
      return Error{"the graphics processor draws no plane that shows shadows alone", "", 0, 0,
                   "choose an engine of the CPU"};
    if (scene.spheres.has_images())
      return Error{"the graphics processor draws no replicated spheres", "", 0, 0, "choose an engine of the CPU"};
    Status status = scene_.set(scene, tree);
    if (status) program_ = nullptr;
    if (status) smaller_by_ = 1;
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
    if (settings.adaptive_samples && settings.view == View::shaded)
      return Error{"the graphics processor draws no adaptive samples", "", 0, 0, "choose a number of samples"};
    if (settings.opacity_rule == OpacityRule::as_one && scene_.lets_light_through())
      return Error{"the graphics processor draws no overlapping spheres as one", "", 0, 0,
                   "choose an engine of the CPU, or another rule"};
    if (settings.cell_lines && settings.view == View::shaded)
      return Error{"the graphics processor draws no edges of a cell", "", 0, 0, "choose an engine of the CPU"};
    if (const Parameter* const row = first_cpu_only(settings); row != nullptr && settings.view == View::shaded)
      return Error{"the graphics processor draws no pictures with " + setting_name(std::string(row->id)), "", 0, 0,
                   "choose an engine of the CPU"};
    if (settings.transparent && settings.view == View::traversal)
      return Error{"this view of the tree has no transparent background", "", 0, 0, "choose another view"};
    const Camera local = relative_to(camera, scene_.origin());
    const Result<CameraUniforms> at =
        CameraUniforms::from(local, scene_.scale(), settings.width_px, settings.height_px);
    if (!at) return at.error();
    camera_ = local;
    settings_ = settings;
    if (settings_.adaptive_samples) settings_.samples_per_pixel = kFewSamples;
    samples_.set(settings_, scene_.has_soft_light(), scene_.scale());

    // The distance view first needs the range of distances of the whole picture, outlines need the first hits of each
    // sample.
    step_ = settings.view == View::distance ? Step::range : Step::light;
    drawn_ =
        settings.view == View::distance ? Tile{0, 0, settings.width_px, settings.height_px} : drawn_pixels(settings);
    find_effects();
    GLint largest = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(drawn_.width(), drawn_.height()) + 2 * border_ > largest)
      return Error{"the graphics processor draws at most " + std::to_string(largest - 2 * border_) + " pixels a side",
                   "", 0, 0, "draw a smaller picture"};
    Result<GlProgram*> program =
        step_ == Step::range ? scene_.program_for_distance_range()
                             : scene_.program_for(settings.view, settings.recursion, layers_, work_.directions > 0);
    if (!program) return program.error();
    if (Status status = film_.resize(drawn_.width(), drawn_.height()); !status) return status;
    if (slices_.size() > 1)
      if (Status status = sample_film_.resize(drawn_.width(), drawn_.height()); !status) return status;
    finder_ = coverer_ = nullptr;
    if (settings.transparent) {
      const Result<GlProgram*> coverer = scene_.program_for_coverage(layers_);
      if (!coverer) return coverer.error();
      if (Status status = coverage_film_.resize(drawn_.width(), drawn_.height()); !status) return status;
      coverer_ = *coverer;
    }
    if (border_ > 0) {
      const Result<GlProgram*> finder = scene_.program_for_first_hits(layers_);
      if (!finder) return finder.error();
      if (Status status = first_hits_.resize(drawn_.width() + 2 * border_, drawn_.height() + 2 * border_); !status)
        return status;
      finder_ = *finder;
    }
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
      if (first || current_walk().at_start()) put_uniforms();
      first = false;
      const Timer draw;
      TileWalk& walk = current_walk();
      const Tile tile = walk.next(std::clamp(kShareOfBudget * budget_ms, 1.0, kLongestDrawMs));
      gl_.Scissor(tile.x0, tile.y0, tile.x1 - tile.x0, tile.y1 - tile.y0);
      gl_.DrawArrays(GL_TRIANGLES, 0, 3);
      if (step_ == Step::first_hits)
        first_hits_.wait();
      else if (step_ == Step::coverage)
        coverage_film_.wait(target());
      else
        current_film().wait(current_target());
      last_ms = draw.elapsed_ms();
      walk.took(last_ms);
      if (!walk.at_end()) continue;
      if (Status status = end_pass(); !status) return status;
    }
    give_state_back();
    if (gl_.GetError() == GL_NO_ERROR) return Done{};
    return Error{"the graphics processor has stopped drawing: its context is lost, or its memory is used up", "", 0, 0,
                 "choose an engine of the CPU"};
  }

  bool finished() const { return step_ != Step::range && pass_ == settings_.samples_per_pixel; }
  int samples_done() const { return step_ == Step::range ? 0 : pass_; }

  // Slices may become smaller during a picture; the share never decreases.
  double done() {
    done_ = finished() ? 1 : std::max(done_, done_now());
    return done_;
  }

  void show(std::uint32_t framebuffer, const GlViewport& viewport, Transfer transfer, bool checks) {
    take_state();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.Viewport(viewport.x, viewport.y, viewport.width, viewport.height);
    gl_.Scissor(viewport.x, viewport.y, viewport.width, viewport.height);
    shower_->use();
    gl_.BindTexture(GL_TEXTURE_2D, film_.texture(pass_ > 0 ? (pass_ - 1) % 2 : 0));
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, coverage_film_.texture(coverer_ != nullptr && pass_ > 0 ? (pass_ - 1) % 2 : 0));
    gl_.ActiveTexture(GL_TEXTURE0);
    shower_->set("film", 0);
    shower_->set("coverage", 1);
    shower_->set("transparent", coverer_ != nullptr && pass_ > 0);
    shower_->set("checks", checks);
    shower_->set("film_size", float(film_.width()), float(film_.height()));
    shower_->set("corner", float(viewport.x), float(viewport.y));
    shower_->set("size", float(viewport.width), float(viewport.height));
    shower_->set("samples", float(std::max(pass_, 1)));
    shower_->set("srgb", settings_.view == View::shaded && transfer == Transfer::srgb);
    shower_->set("only_background", step_ == Step::range);
    shower_->set("background", scene_.background());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    give_state_back();
  }

  Result<Picture> read() {
    BIHIVE_CHECK(finished());
    Picture picture;
    const int width = drawn_.width();
    picture.film = Film(width, drawn_.height());
    picture.primary = std::int64_t{width} * drawn_.height() * settings_.samples_per_pixel;
    const auto samples = static_cast<float>(settings_.samples_per_pixel);
    double others = 0;
    bool stopped = false;
    for_each_row([&](int y, const float* row) {
      for (int x = 0; x < width; ++x, row += 4) {
        picture.film.at(x, y) = {row[0] / samples, row[1] / samples, row[2] / samples};
        others += double(row[3]);
        stopped = stopped || row[3] > kLoopsStopped;
      }
    });
    picture.others = static_cast<std::int64_t>(std::llround(others));
    if (coverer_ != nullptr) read_coverage(picture.film);
    if (gl_.GetError() != GL_NO_ERROR) return Error{"the graphics processor gave no picture", "", 0, 0, ""};
    if (stopped)
      return Error{"the graphics driver has stopped the loops of a pixel: its rays meet too much", "", 0, 0,
                   "choose an engine of the CPU, or fewer generations of rays"};
    if (settings_.view == View::distance && settings_.crop) picture.film = part_of(picture.film, *settings_.crop);
    return picture;
  }

  const std::string& description() const { return description_; }
  void abandon() { abandoned_ = true; }
  bool has_picture() const { return program_ != nullptr; }

 private:
  enum class Step { range, first_hits, coverage, light };

  // The film has the sum of all light; coverage has its own mean.
  void read_coverage(Film& film) {
    const auto samples = static_cast<float>(settings_.samples_per_pixel);
    film.coverage.assign(film.radiance.size(), 0);
    for_each_row(coverage_film_, (pass_ - 1) % 2, [&](int y, const float* row) {
      for (int x = 0; x < film.width; ++x, row += 4) {
        const float covered = row[0];
        Vec3f& light = film.at(x, y);
        film.coverage[film.number_of(x, y)] = covered / samples;
        light = covered > 0 ? light * (samples / covered) : Vec3f{};
      }
    });
  }

  double done_now() const {
    const double samples = settings_.samples_per_pixel;
    const double finding = finder_ != nullptr ? kShareOfFirstHits : 0;
    const double covering = coverer_ != nullptr ? kShareOfFirstHits : 0;
    double of_pass = finding + covering;
    if (step_ == Step::first_hits)
      of_pass = finding * finder_walk_.done();
    else if (step_ == Step::coverage)
      of_pass = finding + covering * finder_walk_.done();
    else
      of_pass += (1 - of_pass) * (slice_ + walk_.done()) / double(slices_.size());
    const double passes = pass_ + of_pass;
    if (settings_.view != View::distance) return passes / samples;
    return (step_ == Step::range ? passes : samples + passes) / (2 * samples);
  }

  // Does the driver stop long loops?
  Status probe_loops() {
    Result<GlProgram> probe = GlProgram::link(
        gl_, "probe_loops", film_.of_bits() ? std::vector<std::string>{"FILM_OF_BITS"} : std::vector<std::string>{});
    if (!probe) return probe.error();
    take_state();
    probe->use();
    sample_film_.draw_into(0);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<float> rgba;
    sample_film_.read(0, 0, 1, rgba);
    stops_loops_ = rgba[0] != 1;
    give_state_back();
    probe->destroy();
    return Done{};
  }

  // The film's texture that the pass draws into; the other is that of the pass before.
  int target() const { return pass_ % 2; }
  // All slices except the last add up in a film of their own.
  bool is_last_slice() const { return slice_ + 1 == static_cast<int>(slices_.size()); }
  const FilmTextures& current_film() const { return is_last_slice() ? film_ : sample_film_; }
  int current_target() const { return is_last_slice() ? target() : slice_ % 2; }
  TileWalk& current_walk() { return step_ == Step::first_hits || step_ == Step::coverage ? finder_walk_ : walk_; }

  // Which properties of scene and settings affect the light of samples?
  void find_effects() {
    const bool shaded = settings_.view == View::shaded;
    layers_ = (shaded || settings_.view == View::recursion) && settings_.opacity_rule != OpacityRule::each_surface &&
              scene_.lets_light_through();
    border_ = 0;
    if (shaded && (settings_.outline || scene_.has_own_lines())) {
      double widest = std::max(double(scene_.widest_outline_px()), settings_.outline ? settings_.outline->width_px : 0);
      if (scene_.has_creases()) widest = std::max(widest, Outline().width_px);
      widest = std::min(widest * line_unit_px(settings_) * settings_.line_scale, kWidestLinePx);
      border_ = widest > 0 ? static_cast<int>(std::max(widest, 1.0)) : 0;
    }
    LightWork work;
    if (shaded) {
      work.lights = scene_.light_count();
      if (settings_.ambient_occlusion) work.directions = settings_.ambient_occlusion->directions;
      if (settings_.shadows && scene_.has_soft_light()) work.points = settings_.light_points;
      work.whole_lights = scene_.has_bands();
    }
    work_ = work;
    divide_light();
    rays_of_pixel_ = work.directions / 2 + (settings_.shadows ? work.lights * work.points : 0);

    fog_depths_ = {};
    if (!shaded || !settings_.fog) return;
    const PixelRays rays(camera_, settings_.width_px, settings_.height_px);
    const auto [near_end, farthest] = scene_.depths(to_double(rays.eye()), rays.forward());
    const double nearest = near_end;  // clang 14 does not capture bindings
    // Spheres without any depth have no fog.
    const double all = farthest - nearest;
    const auto depth_at = [&](double share) { return static_cast<float>(nearest + share * all); };
    if (all > 0) fog_depths_ = {depth_at(settings_.fog->start), depth_at(settings_.fog->end)};
  }

  int rays_of_slice() const { return (layers_ ? kRaysOfLayerSlice : kRaysOfSlice) / smaller_by_; }
  void divide_light() { slices_ = light_slices(work_, std::max(1, rays_of_slice())); }

  // The rays of the slice that was drawn.
  bool has_stopped_loops() {
    if (!stops_loops_ || settings_.view != View::shaded) return false;
    bool stopped = false;
    for_each_row(current_film(), current_target(), [&](int, const float* row) {
      for (int x = 0; x < drawn_.width(); ++x, row += 4) stopped = stopped || row[3] > kLoopsStopped;
    });
    return stopped;
  }

  void start_passes() {
    pass_ = 0;
    done_ = 0;
    start_pass();
    take_state();
    if (step_ != Step::range) film_.fill(0, scene_.background());
    give_state_back();
  }

  void start_pass() {
    slice_ = 0;
    walk_.restart(drawn_.width(), drawn_.height(), block_for(rays_of_pixel_));
    if (step_ != Step::range) begin_step(finder_ != nullptr ? Step::first_hits : Step::coverage);
  }

  void begin_step(Step step) {
    step_ = step == Step::coverage && coverer_ == nullptr ? Step::light : step;
    const int border = step_ == Step::first_hits ? border_ : 0;
    finder_walk_.restart(drawn_.width() + 2 * border, drawn_.height() + 2 * border);
  }

  // First hits, coverage, light of a sample; the next pass; or the picture after the range of distances.
  Status end_pass() {
    if (step_ == Step::first_hits || step_ == Step::coverage) {
      begin_step(step_ == Step::first_hits ? Step::coverage : Step::light);
      return Done{};
    }
    if (rays_of_slice() > 1 && has_stopped_loops()) {
      // Begin the sample again, with smaller slices.
      smaller_by_ *= kSmallerSlices;
      divide_light();
      slice_ = 0;
      walk_.restart(drawn_.width(), drawn_.height(), block_for(rays_of_pixel_));
      if (slices_.size() == 1) return Done{};
      return sample_film_.resize(drawn_.width(), drawn_.height());
    }
    if (!is_last_slice()) {
      ++slice_;
      walk_.restart(drawn_.width(), drawn_.height(), block_for(rays_of_pixel_));
      return Done{};
    }
    ++pass_;
    start_pass();
    if (step_ != Step::range || pass_ < settings_.samples_per_pixel) return Done{};
    nearest_ = std::numeric_limits<float>::max();
    farthest_ = -nearest_;
    for_each_row([&](int, const float* row) {
      for (int x = 0; x < drawn_.width(); ++x, row += 4) {
        nearest_ = std::min(nearest_, row[0]);
        farthest_ = std::max(farthest_, row[1]);
      }
    });
    step_ = Step::light;
    const Result<GlProgram*> program =
        scene_.program_for(settings_.view, settings_.recursion, layers_, work_.directions > 0);
    if (!program) return program.error();
    program_ = *program;
    start_passes();
    take_state();
    return Done{};
  }

  // Every row of the last complete pass.
  template <class Use>
  void for_each_row(const Use& use) {
    for_each_row(film_, (pass_ - 1) % 2, use);
  }
  template <class Use>
  void for_each_row(const FilmTextures& film, int index, const Use& use) {
    std::vector<float> rows;
    for (int y0 = 0; y0 < drawn_.height(); y0 += kRowsAtOnce) {
      const int y1 = std::min(y0 + kRowsAtOnce, drawn_.height());
      film.read(index, y0, y1, rows);
      for (int y = y0; y < y1; ++y)
        use(y, rows.data() + 4 * static_cast<std::size_t>(drawn_.width()) * static_cast<std::size_t>(y - y0));
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  }

  void put_uniforms() {
    const bool finds = step_ == Step::first_hits;
    const bool covers = step_ == Step::coverage;
    GlProgram& program = finds ? *finder_ : covers ? *coverer_ : *program_;
    program.use();
    scene_.put(program);
    samples_.put(program, pass_, kUnitOfSamples);
    // begin() has asked for the middle of the lens, so there is no error.
    const Result<CameraUniforms> camera = CameraUniforms::from(camera_, scene_.scale(), settings_.width_px,
                                                               settings_.height_px, samples_.camera_sample(pass_).lens);
    BIHIVE_CHECK(camera.ok());
    camera->put(program);
    const int border = finds ? border_ : 0;
    program.set("film_corner", float(drawn_.x0 - border), float(drawn_.y0 - border));
    if (finds)
      first_hits_.draw_into();
    else
      put_film_before(program, covers ? coverage_film_ : film_);
    if (covers) coverage_film_.draw_into(target());
    if (!finds && !covers) put_light_uniforms(program);
    gl_.Enable(GL_SCISSOR_TEST);
  }

  void put_film_before(GlProgram& program, const FilmTextures& film) {
    gl_.ActiveTexture(GL_TEXTURE0 + kUnitOfFilm);
    gl_.BindTexture(GL_TEXTURE_2D, film.texture(1 - target()));
    program.set("film_before", kUnitOfFilm);
    program.set("sample_index", pass_);
  }

  void put_light_uniforms(GlProgram& program) {
    gl_.ActiveTexture(GL_TEXTURE0 + kUnitOfFirstHits);
    gl_.BindTexture(GL_TEXTURE_2D, first_hits_.texture());
    gl_.ActiveTexture(GL_TEXTURE0);
    program.set("first_hits", kUnitOfFirstHits);
    program.set("recursion", settings_.recursion);
    program.set("shadows", settings_.shadows);
    program.set("first_surfaces", settings_.opacity_rule == OpacityRule::first);
    program.set("faintest_ray", layers_ && scene_.is_passed_straight() ? float(kFaintestRay) : 0);
    program.set("without_background", settings_.transparent);
    program.set("view", settings_.view == View::normal ? 0 : settings_.view == View::distance ? 1 : 2);
    program.set("nearest", nearest_);
    program.set("farthest", farthest_);
    put_slice(program);
    put_effects(program);
    current_film().draw_into(current_target());
  }

  void put_slice(GlProgram& program) {
    gl_.ActiveTexture(GL_TEXTURE0 + kUnitOfSlices);
    gl_.BindTexture(GL_TEXTURE_2D, sample_film_.texture(1 - slice_ % 2));
    gl_.ActiveTexture(GL_TEXTURE0);
    const LightSlice& slice = slices_[static_cast<std::size_t>(slice_)];
    program.set("slices_before", kUnitOfSlices);
    program.set("first_slice", slice_ == 0);
    program.set("last_slice", is_last_slice());
    program.set("direction_begin", slice.direction_begin);
    program.set("direction_end", slice.direction_end);
    program.set("light_begin", slice.light_begin);
    program.set("light_end", slice.light_end);
    program.set("light_point_begin", slice.point_begin);
    program.set("light_point_end", slice.point_end);
  }

  void put_effects(GlProgram& program) {
    program.set("tone_curve", static_cast<int>(settings_.tone.curve));
    program.set("exposure_factor", static_cast<float>(exposure_factor(settings_.tone)));
    const Outline outline = settings_.outline.value_or(Outline{});
    program.set("has_lines", border_ > 0);
    program.set("border", border_);
    program.set("picture_outline_px", settings_.outline ? float(outline.width_px) : 0);
    program.set("has_creases", scene_.has_creases());
    program.set("line_unit_px", float(line_unit_px(settings_) * settings_.line_scale));
    program.set("outline_step", float(outline.step));
    program.set("outline_colour", to_float(outline.colour));
    const bool fog = settings_.fog && fog_depths_.first < fog_depths_.second;
    program.set("fog_strength", fog ? float(settings_.fog->strength) : 0);
    program.set("fog_depths", fog_depths_.first, fog_depths_.second);
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
  FilmTextures film_, sample_film_, coverage_film_;
  FirstHitsTexture first_hits_;
  SampleTextures samples_;
  SceneOnGpu scene_;
  std::optional<GlProgram> shower_;
  GLuint vertices_ = 0;
  std::string description_;
  bool abandoned_ = false;

  // The unfinished picture.
  RenderSettings settings_;
  Camera camera_;
  Tile drawn_{};                  // the film's pixels in the whole picture
  GlProgram* program_ = nullptr;  // null: no picture was begun
  GlProgram* finder_ = nullptr;   // for first hits; null: the picture needs none
  GlProgram* coverer_ = nullptr;  // the same for coverage
  Step step_ = Step::light;
  TileWalk walk_, finder_walk_;
  int pass_ = 0;  // complete passes, of the picture or of its range of distances
  bool layers_ = false;
  int border_ = 0;  // of the first hits around the picture
  bool stops_loops_ = false;
  int smaller_by_ = 1;  // divisor of the usual slice size, for this scene
  double done_ = 0;
  LightWork work_;
  std::vector<LightSlice> slices_{{}};
  int slice_ = 0;
  int rays_of_pixel_ = 0;
  std::pair<float, float> fog_depths_;
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
void GlRenderer::show(std::uint32_t framebuffer, const GlViewport& viewport, Transfer transfer, bool checks) {
  if (implementation_->has_picture()) implementation_->show(framebuffer, viewport, transfer, checks);
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
