#include "bihive/viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/timer.h"
#include "bihive/render/tree_picture.h"
#include "bihive/scene/load_scene.h"
#include "bihive/viewer/gpu_pictures.h"
#include "bihive/viewer/orbit.h"
#include "bihive/viewer/pacing.h"
#include "bihive/viewer/picture_to_save.h"
#include "bihive/viewer/scene_trees.h"

namespace bihive {
namespace {

constexpr int kLargestSidePx = 16384;
// A picture of something that moves may overrun the budget that often, rather than never be seen.
constexpr double kMostBudgets = 4;

Error bad_setting(const std::string& message, const std::string& hint = "") {
  return {message, "", 0, 0, hint};
}

Status check_ranges(const ViewerSettings& settings) {
  const auto outside = [](std::int64_t value, std::int64_t min, std::int64_t max) {
    return value < min || value > max;
  };
  if (outside(settings.recursion, 1, kMostRecursion))
    return bad_setting("recursion must be from 1 to " + std::to_string(kMostRecursion));
  if (outside(settings.samples_per_pixel, 1, kMostSamples))
    return bad_setting("samples a pixel must be from 1 to " + std::to_string(kMostSamples));
  if (settings.max_prims.value_or(1) < 1 || settings.max_depth.value_or(1) < 1)
    return bad_setting("max_prims and max_depth must be at least 1");
  return check_camera(settings.camera);
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.look_at == b.look_at && a.up == b.up && a.fov_deg == b.fov_deg;
}

bool same_tree(const ViewerSettings& a, const ViewerSettings& b) {
  return a.max_prims == b.max_prims && a.max_depth == b.max_depth;
}

bool needs_reference_tree(const ViewerSettings& settings) {
  return settings.engine == ViewerEngine::gpu || settings.view == View::traversal || settings.view == View::tree;
}

TreeParameters tree_parameters(const ViewerSettings& settings) {
  return {settings.max_prims, settings.max_depth};
}

// A scene on show. Never moved: its trees refer to its spheres.
struct Shown {
  Scene scene;
  SceneFacts facts;
  Camera own_camera;  // if it has one
  bool has_camera = false, has_lights = false;
  double diagonal = 0;
  std::unique_ptr<SceneTrees> trees;
};

}  // namespace

class Viewer::Implementation {
 public:
  // --- The scene ----------------------------------------------------------------------------------------------

  Result<SceneFacts> load(Result<LoadedScene> loaded) {
    if (!loaded) return loaded.error();
    SceneFacts facts{loaded->scene.name, loaded->format,           loaded->scene.spheres.size(),
                     loaded->frames,     std::move(loaded->rules), std::move(loaded->warnings)};
    return load(std::move(loaded->scene), std::move(facts), loaded->has_camera, loaded->has_lights);
  }

  Result<SceneFacts> load(Scene scene, SceneFacts facts, bool has_camera, bool has_lights) {
    if (scene.spheres.empty()) return bad_setting("the scene has no spheres");
    auto next = std::make_unique<Shown>();
    next->scene = std::move(scene);
    next->facts = std::move(facts);
    next->own_camera = next->scene.camera;
    next->has_camera = has_camera;
    next->has_lights = has_lights;
    const SphereSet::Bounds bounds = next->scene.spheres.bounds();
    next->diagonal = length(bounds.hi - bounds.lo);

    // What it brings along, and what stays.
    ViewerSettings settings = settings_;
    const PictureDefaults& picture = next->scene.picture;
    settings.recursion = std::clamp(picture.recursion, 1, kMostRecursion);
    settings.samples_per_pixel = std::clamp(picture.samples_per_pixel, 1, kMostSamples);
    settings.shadows = picture.shadows;
    const std::optional<ViewFrom> side = has_camera ? std::nullopt : std::optional(ViewFrom::front);
    settings.camera = side ? framed(*next, *side, settings) : next->own_camera;
    if (Status status = check_ranges(settings); !status) return status.error();
    next->trees = std::make_unique<SceneTrees>(next->scene.spheres, tree_parameters(settings));
    if (Status status = make_ready(*next, *next->trees, settings, /*upload=*/true); !status) return status.error();

    drop_picture();
    picture_.reset();
    shown_ = std::move(next);
    settings_ = settings;
    framed_from_ = side;
    image_ = {};
    if (gpu_) gpu_->forget();
    start_anew();
    return shown_->facts;
  }

  const SceneFacts& facts() const {
    static const SceneFacts kNone;
    return shown_ ? shown_->facts : kNone;
  }
  const Scene& scene() const {
    static const Scene kNone;
    return shown_ ? shown_->scene : kNone;
  }

  // --- The graphics processor ---------------------------------------------------------------------------------

  Status attach_gl(const GlFunctions& functions) {
    if (gpu_) detach_gl(false);
    Result<std::unique_ptr<GpuPictures>> gpu = GpuPictures::create(functions);
    if (!gpu) return gpu.error();
    gpu_ = std::move(*gpu);
    return Done{};
  }

  void detach_gl(bool lost) {
    if (!gpu_) return;
    drop_picture();
    if (lost) gpu_->abandon();
    gpu_.reset();
    if (settings_.engine != ViewerEngine::gpu) return;
    settings_.engine = ViewerEngine::cpu;
    start_anew();
  }

  bool has_gl() const { return gpu_ != nullptr; }
  std::string gl_description() const { return gpu_ ? gpu_->renderer().description() : ""; }

  // --- What is seen -------------------------------------------------------------------------------------------

  const ViewerSettings& settings() const { return settings_; }

  Status set(ViewerSettings settings) {
    if (Status status = check_ranges(settings); !status) return status;
    drop_picture();

    // A camera that shows the whole set does so in the new view too.
    const bool keeps_side = framed_from_ && same_camera(settings.camera, settings_.camera);
    if (shown_ && keeps_side) settings.camera = framed(*shown_, *framed_from_, settings);
    if (shown_) {
      std::unique_ptr<SceneTrees> other_trees;
      if (!same_tree(settings, settings_))
        other_trees = std::make_unique<SceneTrees>(shown_->scene.spheres, tree_parameters(settings));
      const bool upload = other_trees || settings_.engine != ViewerEngine::gpu;
      SceneTrees& trees = other_trees ? *other_trees : *shown_->trees;
      if (Status status = make_ready(*shown_, trees, settings, upload); !status) return status;
      picture_.reset();
      if (other_trees) shown_->trees = std::move(other_trees);
    } else if (settings.engine == ViewerEngine::gpu) {
      if (Status status = check_gpu(settings); !status) return status;
    }
    if (!keeps_side) framed_from_.reset();
    settings_ = settings;
    start_anew();
    return Done{};
  }

  void resize(int width_px, int height_px) {
    BIHIVE_CHECK(width_px >= 1 && width_px <= kLargestSidePx && height_px >= 1 && height_px <= kLargestSidePx);
    if (width_px == size_.width && height_px == size_.height) return;
    size_ = {width_px, height_px};
    if (framed_from_) look_from(*framed_from_);
    start_anew();
  }

  void orbit(double dx_px, double dy_px) { move_to(orbited(settings_.camera, dx_px, dy_px, size_)); }
  void pan(double dx_px, double dy_px) { move_to(panned(settings_.camera, dx_px, dy_px, size_)); }

  void zoom(double factor, double x_px, double y_px) {
    if (!shown_ || !(std::isfinite(factor) && factor > 0)) return;
    const Camera& camera = settings_.camera;
    move_to(zoomed(camera, factor, seen_at(x_px, y_px), distance_limits(camera, shown_->diagonal)));
  }

  void look_from(ViewFrom side) {
    if (!shown_) return;
    framed_from_ = side;
    settings_.camera = framed(*shown_, side, settings_);
    restart_ = true;
  }

  void home() {
    if (!shown_) return;
    if (!shown_->has_camera) return look_from(ViewFrom::front);
    move_to(shown_->own_camera);
  }

  // --- Pictures -----------------------------------------------------------------------------------------------

  Result<FrameReport> frame(double budget_ms) {
    const Timer timer;
    drop_picture();
    FrameReport report;
    if (shown_ && (restart_ || !settled_)) {
      if (Status status = go_on(budget_ms, report.drawn); !status) {
        give_up();
        return status.error();
      }
      if (report.drawn && moving_) rate_.moved(clock_.elapsed_ms());
    }
    const StepShare share = share_of_step(step_, settings_.samples_per_pixel);
    report.settled = !shown_ || (settled_ && !restart_);
    report.done = report.settled ? 1 : share.before + share.own * done_of_step();
    report.divisor = step_.divisor;
    report.frame_ms = timer.elapsed_ms();
    report.fps = rate_.fps();
    report.mray_per_s = mray_per_s_;
    return report;
  }

  const Image& image() const { return image_; }

  void show(std::uint32_t framebuffer, const GlViewport& viewport) {
    if (gpu_) gpu_->show(framebuffer, viewport);
  }

  // --- A picture to be saved ----------------------------------------------------------------------------------

  Status begin_picture(int width_px, int height_px, int samples_per_pixel) {
    if (!shown_) return bad_setting("there is no scene yet");
    RenderSettings settings = render_settings({1, samples_per_pixel});
    settings.width_px = width_px;
    settings.height_px = height_px;

    // What is on the way to the screen gives way.
    drop_picture();
    drop_step();
    prepare_scene();
    Result<PictureToSave> picture = begun_to_save(settings);
    if (!picture) return picture.error();
    to_save_ = std::move(*picture);
    return Done{};
  }

  Result<double> advance_picture(double budget_ms) {
    if (!to_save_) return bad_setting("no picture to be saved is in the making");
    if (Status status = to_save_->advance(budget_ms); !status) {
      drop_picture();
      return status.error();
    }
    return to_save_->done();
  }

  Result<Image> take_picture() {
    if (!to_save_ || !to_save_->finished()) return bad_setting("no picture to be saved is finished");
    Result<Image> image = to_save_->take();
    drop_picture();
    return image;
  }

  void drop_picture() { to_save_.reset(); }

  Result<Image> picture(int width_px, int height_px, int samples_per_pixel) {
    if (Status status = begin_picture(width_px, height_px, samples_per_pixel); !status) return status.error();
    for (;;) {
      const Result<double> done = advance_picture(kSliceMs);
      if (!done) return done.error();
      if (*done >= 1) return take_picture();
    }
  }

  std::string statistics_json() {
    if (!shown_) return R"({"error": "there is no scene yet"})";
    const Result<std::string> json = shown_->trees->statistics(shown_->scene.seed);
    return json ? *json : R"({"error": "not enough memory for the trees"})";
  }

 private:
  static constexpr double kSliceMs = 100;

  // --- Readiness ----------------------------------------------------------------------------------------------

  Status check_gpu(const ViewerSettings& settings) const {
    if (!gpu_) return bad_setting("there is no graphics processor", "choose the CPU engine");
    if (settings.view == View::tree)
      return bad_setting("the graphics processor does not draw the tree itself", "choose the CPU engine");
    return Done{};
  }

  // Builds and uploads what the settings need; on an Error nothing on show has changed.
  Status make_ready(const Shown& shown, SceneTrees& trees, const ViewerSettings& settings, bool upload) {
    if (settings.engine == ViewerEngine::gpu)
      if (Status status = check_gpu(settings); !status) return status;
    const Result<const Tracer*> tracer = tracer_for(trees, settings);
    if (!tracer) return tracer.error();
    if (settings.engine != ViewerEngine::gpu || !upload) return Done{};
    return gpu_->renderer().set_scene(shown.scene, (*tracer)->tree());
  }

  static Result<const Tracer*> tracer_for(SceneTrees& trees, const ViewerSettings& settings) {
    return needs_reference_tree(settings) ? trees.reference() : trees.wide();
  }

  Camera framed(const Shown& shown, ViewFrom side, const ViewerSettings& settings) const {
    const double fov_deg = shown.own_camera.fov_deg;
    return settings.view == View::tree ? frame_tree(shown.scene.spheres, side, fov_deg, size_.width, size_.height)
                                       : frame_spheres(shown.scene.spheres, side, fov_deg, size_.width, size_.height);
  }

  // --- Moves --------------------------------------------------------------------------------------------------

  void move_to(const Camera& camera) {
    if (!shown_) return;
    framed_from_.reset();
    settings_.camera = camera;
    restart_ = true;
  }

  // What is seen at (x, y), or a point as far away as what is looked at.
  Vec3d seen_at(double x_px, double y_px) const {
    const Camera& camera = settings_.camera;
    if (const Tracer* tracer = shown_->trees->any()) {
      const Ray ray = PixelRays(camera, size_.width, size_.height).at(x_px, y_px);
      const Hit hit = tracer->closest_hit(ray);
      if (hit.found()) return to_double(ray.origin) + hit.t * to_double(ray.direction);
    }
    return point_under(camera, x_px, y_px, size_);
  }

  // --- Steps --------------------------------------------------------------------------------------------------

  void drop_step() {
    picture_.reset();
    begun_ = false;
  }
  void start_anew() {
    drop_step();
    restart_ = true;
  }
  // After an Error: not again and again.
  void give_up() {
    drop_step();
    restart_ = false;
    settled_ = true;
  }

  RenderSettings render_settings(PictureStep step) const {
    RenderSettings settings;
    settings.width_px = divided(size_.width, step.divisor);
    settings.height_px = divided(size_.height, step.divisor);
    settings.samples_per_pixel = step.samples;
    settings.recursion = settings_.recursion;
    settings.shadows = settings_.shadows;
    settings.view = settings_.view;
    return settings;
  }

  // Camera and light as they are now.
  void prepare_scene() {
    Scene& scene = shown_->scene;
    scene.camera = settings_.camera;
    if (!shown_->has_lights) scene.lights = {light_behind(scene.camera)};
  }

  PixelCost& cost() { return costs_[settings_.engine == ViewerEngine::gpu ? 1 : 0]; }

  Status begin_step() {
    prepare_scene();
    spent_ms_ = 0;
    shown_samples_ = 0;
    begun_ = true;
    const RenderSettings settings = render_settings(step_);
    if (settings_.engine == ViewerEngine::gpu) return begin_gpu(settings);
    const Result<const Tracer*> tracer = tracer_for(*shown_->trees, settings_);
    if (!tracer) return tracer.error();
    Result<SlicedPicture> picture = SlicedPicture::begin(shown_->scene, **tracer, settings, std::move(film_));
    film_ = {};
    if (!picture) return picture.error();
    picture_ = std::move(*picture);
    return Done{};
  }

  Status set_gpu_lights() { return shown_->has_lights ? Status(Done{}) : gpu_->renderer().set_lights(shown_->scene); }

  Status begin_gpu(const RenderSettings& settings) {
    if (Status status = set_gpu_lights(); !status) return status;
    return gpu_->begin(shown_->scene, settings);
  }

  Result<PictureToSave> begun_to_save(const RenderSettings& settings) {
    if (settings_.engine == ViewerEngine::gpu) {
      if (Status status = set_gpu_lights(); !status) return status.error();
      return PictureToSave::by_gpu(*gpu_, shown_->scene, settings);
    }
    const Result<const Tracer*> tracer = tracer_for(*shown_->trees, settings_);
    if (!tracer) return tracer.error();
    return PictureToSave::by_cpu(shown_->scene, **tracer, settings);
  }

  // One step, or a part of it.
  Status go_on(double budget_ms, bool& drawn) {
    // A picture of something that moves is finished before the next, or a fast hand would never see one.
    if (restart_ && !(begun_ && moving_)) {
      drop_step();
      restart_ = false;
      settled_ = false;
      moving_ = true;
      step_ = {divisor_for(size_.width, size_.height, cost().ms_per_pixel(), budget_ms), 1};
      if (Status status = begin_step(); !status) return status;
    } else if (!begun_) {
      moving_ = false;
      step_ = finer_step(step_, settings_.samples_per_pixel);
      if (Status status = begin_step(); !status) return status;
    }

    const Timer timer;
    const double limit_ms = moving_ ? kMostBudgets * budget_ms : budget_ms;
    if (settings_.engine == ViewerEngine::gpu) {
      if (Status status = gpu_->renderer().advance(limit_ms); !status) return status;
      spent_ms_ += timer.elapsed_ms();
      return take_gpu(drawn);
    }
    picture_->advance(limit_ms);
    spent_ms_ += timer.elapsed_ms();
    take_cpu(drawn);
    return Done{};
  }

  void take_cpu(bool& drawn) {
    if (!picture_->finished()) return;
    Rendered rendered = picture_->take();
    image_ = image_from_film(rendered.film, settings_.view, shown_->scene.picture.transfer);
    const RenderCounts& rays = rendered.rays;
    const auto all = static_cast<double>(rays.primary + rays.shadow + rays.reflected + rays.transmitted);
    if (rendered.render_ms > 0) mray_per_s_ = all / rendered.render_ms / 1000;
    film_ = std::move(rendered.film);
    picture_.reset();
    drawn = true;
    finish_step();
  }

  Status take_gpu(bool& drawn) {
    drawn = gpu_->renderer().samples_done() > shown_samples_;
    if (drawn)
      if (Status status = gpu_->keep(); !status) return status;
    shown_samples_ = gpu_->renderer().samples_done();
    if (!gpu_->renderer().finished()) return Done{};
    const PictureStep step = step_;
    finish_step();

    // How many rays of other kinds a pixel sends out is asked at rest only: it takes reading the picture back.
    const double primary =
        static_cast<double>(divided(size_.width, step.divisor)) * divided(size_.height, step.divisor) * step.samples;
    if (settled_) {
      const Result<GlRenderer::Picture> picture = gpu_->renderer().read();
      if (!picture) return picture.error();
      rays_per_primary_ = static_cast<double>(picture->primary + picture->others) / primary;
    }
    if (spent_ms_ > 0) mray_per_s_ = primary * rays_per_primary_ / spent_ms_ / 1000;
    return Done{};
  }

  void finish_step() {
    if (step_.samples == 1)
      cost().measured(spent_ms_,
                      std::int64_t{divided(size_.width, step_.divisor)} * divided(size_.height, step_.divisor));
    begun_ = false;
    settled_ = step_ == PictureStep{1, settings_.samples_per_pixel};
  }

  double done_of_step() const {
    if (!begun_) return 1;
    if (settings_.engine == ViewerEngine::gpu) return gpu_->renderer().done();
    return picture_ ? picture_->done() : 0;
  }

  std::unique_ptr<Shown> shown_;
  std::unique_ptr<GpuPictures> gpu_;
  ViewerSettings settings_;
  PictureSizePx size_{1280, 720};
  std::optional<ViewFrom> framed_from_;  // the camera shows the whole set from there, as look_from() placed it

  // The picture in the making.
  bool restart_ = false;  // something has changed since the step was begun
  bool settled_ = true;
  bool moving_ = false;  // the step is the first after a change
  bool begun_ = false;
  PictureStep step_;
  std::optional<SlicedPicture> picture_;  // on the CPU
  Film film_;                             // whose memory the next picture takes
  Image image_;
  std::optional<PictureToSave> to_save_;
  int shown_samples_ = 0;  // on the graphics processor
  double spent_ms_ = 0;

  // Paces.
  Timer clock_;
  FrameRate rate_;
  PixelCost costs_[2];  // CPU, GPU
  double rays_per_primary_ = 1;
  double mray_per_s_ = 0;
};

Viewer::Viewer() : implementation_(std::make_unique<Implementation>()) {}
Viewer::~Viewer() = default;

Result<SceneFacts> Viewer::load_built_in(const std::string& name, const ScenarioParameters& parameters,
                                         const ReadOptions& options) {
  return implementation_->load(built_in_scene(name, parameters, options));
}
Result<SceneFacts> Viewer::load(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return implementation_->load(load_scene(bytes, name, options));
}
Result<SceneFacts> Viewer::load(Scene scene, SceneFacts facts, bool has_camera, bool has_lights) {
  return implementation_->load(std::move(scene), std::move(facts), has_camera, has_lights);
}
const SceneFacts& Viewer::facts() const {
  return implementation_->facts();
}
const Scene& Viewer::scene() const {
  return implementation_->scene();
}

Status Viewer::attach_gl(const GlFunctions& functions) {
  return implementation_->attach_gl(functions);
}
void Viewer::detach_gl(bool lost) {
  implementation_->detach_gl(lost);
}
bool Viewer::has_gl() const {
  return implementation_->has_gl();
}
std::string Viewer::gl_description() const {
  return implementation_->gl_description();
}

const ViewerSettings& Viewer::settings() const {
  return implementation_->settings();
}
Status Viewer::set(const ViewerSettings& settings) {
  return implementation_->set(settings);
}
void Viewer::resize(int width_px, int height_px) {
  implementation_->resize(width_px, height_px);
}
void Viewer::orbit(double dx_px, double dy_px) {
  implementation_->orbit(dx_px, dy_px);
}
void Viewer::pan(double dx_px, double dy_px) {
  implementation_->pan(dx_px, dy_px);
}
void Viewer::zoom(double factor, double x_px, double y_px) {
  implementation_->zoom(factor, x_px, y_px);
}
void Viewer::look_from(ViewFrom side) {
  implementation_->look_from(side);
}
void Viewer::home() {
  implementation_->home();
}

Result<FrameReport> Viewer::frame(double budget_ms) {
  return implementation_->frame(budget_ms);
}
const Image& Viewer::image() const {
  return implementation_->image();
}
void Viewer::show(std::uint32_t framebuffer, const GlViewport& viewport) {
  implementation_->show(framebuffer, viewport);
}
Status Viewer::begin_picture(int width_px, int height_px, int samples_per_pixel) {
  return implementation_->begin_picture(width_px, height_px, samples_per_pixel);
}
Result<double> Viewer::advance_picture(double budget_ms) {
  return implementation_->advance_picture(budget_ms);
}
Result<Image> Viewer::take_picture() {
  return implementation_->take_picture();
}
void Viewer::drop_picture() {
  implementation_->drop_picture();
}
Result<Image> Viewer::picture(int width_px, int height_px, int samples_per_pixel) {
  return implementation_->picture(width_px, height_px, samples_per_pixel);
}
std::string Viewer::statistics_json() const {
  return implementation_->statistics_json();
}

}  // namespace bihive
