#include "bihive/viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/compare/comparison_json.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/memory.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/focus.h"
#include "bihive/scene/wide_angle.h"
#include "bihive/settings/parameter.h"
#include "bihive/viewer/gpu_pictures.h"
#include "bihive/viewer/orbit.h"
#include "bihive/viewer/picture_steps.h"
#include "bihive/viewer/picture_to_save.h"
#include "bihive/viewer/prepared_frame.h"
#include "bihive/viewer/scene_input.h"

namespace bihive {
namespace {

constexpr int kLargestSidePx = 16384;

// Whether both ask for the same sticks.
bool same_sticks(const LayeredSettings& a, const LayeredSettings& b) {
  const std::span<const Parameter> parameters = picture_parameters();
  return std::all_of(parameters.begin(), parameters.end(), [&](const Parameter& parameter) {
    return !parameter.makes_sticks || a.value(parameter) == b.value(parameter);
  });
}

Error bad_setting(const std::string& message, const std::string& hint = "") {
  return {message, "", 0, 0, hint};
}

}  // namespace

class Viewer::Implementation {
 public:
  // --- The scene ----------------------------------------------------------------------------------------------

  Result<SceneFacts> load(Result<SceneInput> input) {
    if (!input) return input.error();
    if (input->facts().spheres == 0) return bad_setting("the scene has no spheres");
    ViewerLook look;
    if (input->facts().is_file_of_spheres) look.style = look_.style;
    Result<SceneInput::Looked> looked = input->looked_at(look, {}, {});
    if (!looked && !look.style.empty()) {
      // The style of the scene before may not suit these spheres.
      const std::string why = looked.error().message;
      looked = input->looked_at({}, {}, {});
      if (looked) input->add_warning("not in the style " + look.style + ": " + why);
      look.style.clear();
    }
    if (!looked) return looked.error();
    auto next = std::make_unique<ShownScene>(std::move(looked->loaded));

    // A new scene resets these settings; the others stay.
    ViewerSettings settings = settings_;
    settings.replicate.reset();
    settings.picture = {next->scene.picture, {}};
    const std::optional<ViewFrom> side = next->has_camera ? std::nullopt : std::optional(ViewFrom::front);
    settings.camera = next->own_camera;
    if (side) settings.camera = framed(*next, *side, settings, /*angle_is_users=*/false);
    settings.focus_on.clear();
    put_below(*next, settings);
    if (Status status = check_settings(settings); !status) return status.error();
    next->trees = std::make_unique<SceneTrees>(next->scene, tree_parameters(settings));
    if (Status status = make_ready(*next, *next->trees, settings, /*upload=*/true); !status) return status.error();

    drop_picture();
    steps_.drop_step();
    shown_ = std::move(next);
    input_ = std::move(*input);
    ++version_;
    look_ = look;
    settings_ = settings;
    framed_from_ = side;
    turned_from_.reset();
    is_seen_ = false;
    chosen_fov_deg_ = shown_->own_camera.fov_deg;
    angle_is_users_ = false;
    steps_.forget_image();
    if (gpu_) gpu_->forget();
    steps_.start_anew();
    return input_->facts();
  }

  const SceneFacts& facts() const {
    static const SceneFacts kNone;
    return input_ ? input_->facts() : kNone;
  }
  const Scene& scene() const {
    static const Scene kNone;
    return shown_ ? shown_->scene : kNone;
  }
  const SphereSet& input_spheres() const { return input_ ? input_->spheres() : scene().spheres; }

  // --- The look -----------------------------------------------------------------------------------------------

  const ViewerLook& look() const { return look_; }

  Result<std::vector<std::int64_t>> set_look(const ViewerLook& look, std::size_t* failed_row) {
    if (failed_row != nullptr) *failed_row = look.rows.size();
    if (!input_) return bad_setting("there is no scene yet");
    Result<SceneInput::Looked> looked =
        input_->looked_at(look, settings_.replicate, settings_.picture.user, failed_row);
    if (!looked) return looked.error();
    if (failed_row != nullptr) *failed_row = look.rows.size();
    ViewerSettings settings = settings_;
    auto next = std::make_unique<ShownScene>(std::move(looked->loaded));
    // Cutting does not move the camera, so that what remains stays in place.
    const bool is_cut = is_seen_ && !shown_->same_clips(*next);
    const bool keeps_side = framed_from_ && !is_cut;
    if (keeps_side) settings.camera.fov_deg = chosen_fov_deg_;
    if (Status status = show(std::move(next), settings, keeps_side, angle_is_users_); !status) return status.error();
    if (is_cut && framed_from_) {
      turned_from_ = settings.camera;
      framed_from_.reset();
    }
    if (is_cut && turned_from_) settings.camera = far_enough(settings.camera, size_);
    look_ = look;
    settings_ = settings;
    steps_.start_anew();
    return std::move(looked->counts);
  }

  // --- Frames -------------------------------------------------------------------------------------------------

  std::shared_ptr<const FrameMaker> frame_maker() {
    if (!input_ || !input_->facts().is_file_of_spheres) return nullptr;
    if (maker_ && maker_version_ == version_) return maker_;
    FrameMaker::Choices choices{input_->facts().name, look_, settings_, shown_->scene.coloured_by, {}, version_};
    if (!look_.floor.empty()) choices.floor = shown_->scene.plane->plane;
    maker_ = std::make_shared<const FrameMaker>(std::make_shared<const FrameMaker::Choices>(std::move(choices)));
    maker_version_ = version_;
    return maker_;
  }

  Result<bool> show_frame(PreparedFrame& frame) {
    BIHIVE_CHECK(frame.shown != nullptr);
    if (frame.version != version_) return false;
    if (Status status = make_ready(*frame.shown, *frame.shown->trees, settings_, /*upload=*/true); !status)
      return status.error();
    drop_picture();
    steps_.drop_step();
    shown_ = std::move(frame.shown);
    input_ = std::move(frame.input);
    steps_.start_anew();
    return true;
  }

  // --- The graphics processor ---------------------------------------------------------------------------------

  Status attach_gl(const GlFunctions& functions) {
    if (gpu_) detach_gl(false);
    Result<std::unique_ptr<GpuPictures>> gpu = GpuPictures::create(functions);
    if (!gpu) return gpu.error();
    gpu_ = std::move(*gpu);
    gpu_->show_checks(checks_);
    return Done{};
  }

  void detach_gl(bool lost) {
    if (!gpu_) return;
    if (settings_.engine == ViewerEngine::gpu) drop_picture();
    if (lost) gpu_->abandon();
    gpu_.reset();
    if (settings_.engine != ViewerEngine::gpu) return;
    settings_.engine = ViewerEngine::cpu;
    steps_.start_anew();
  }

  bool has_gl() const { return gpu_ != nullptr; }
  std::string gl_description() const { return gpu_ ? gpu_->renderer().description() : ""; }

  // --- View ---------------------------------------------------------------------------------------------------

  const ViewerSettings& settings() const { return settings_; }

  Status set(ViewerSettings settings) {
    if (shown_) put_below(*shown_, settings);
    if (Status status = check_settings(settings); !status) return status;
    if (Status status = check_requests(settings); !status) return status;
    // Only another projection, angle or lens: the camera still shows the whole set.
    const bool keeps_side = framed_from_ && same_place(settings.camera, settings_.camera);
    // Another projection resets the angle; a set that is framed again keeps the chosen one.
    const bool chooses_angle = settings.camera.projection == settings_.camera.projection &&
                               settings.camera.fov_deg != settings_.camera.fov_deg;
    const double fov_deg = chooses_angle ? settings.camera.fov_deg : chosen_fov_deg_;
    const bool angle_is_users = chooses_angle || angle_is_users_;
    if (keeps_side) settings.camera.fov_deg = fov_deg;
    if (!shown_) {
      if (settings.engine == ViewerEngine::gpu)
        if (Status status = check_gpu(settings); !status) return status;
    } else {
      // Copies are other spheres, and the user may ask for other sticks.
      std::unique_ptr<ShownScene> next;
      if (settings.replicate != settings_.replicate || !same_sticks(settings.picture, settings_.picture)) {
        Result<SceneInput::Looked> looked = input_->looked_at(look_, settings.replicate, settings.picture.user);
        if (!looked) return looked.error();
        next = std::make_unique<ShownScene>(std::move(looked->loaded));
      }
      if (Status status = show(std::move(next), settings, keeps_side, angle_is_users); !status) return status;
    }
    chosen_fov_deg_ = fov_deg;
    angle_is_users_ = angle_is_users;
    if (!keeps_side) framed_from_.reset();
    if (!(settings.camera == settings_.camera)) turned_from_.reset();
    settings_ = settings;
    steps_.start_anew();
    return Done{};
  }

  void resize(int width_px, int height_px) {
    BIHIVE_CHECK(width_px >= 1 && width_px <= kLargestSidePx && height_px >= 1 && height_px <= kLargestSidePx);
    if (width_px == size_.width && height_px == size_.height) return;
    size_ = {width_px, height_px};
    if (framed_from_)
      look_from(*framed_from_);
    else if (turned_from_)
      settings_.camera = far_enough(settings_.camera, size_);
    steps_.start_anew();
  }

  // A camera that shows the whole set still does so while the set turns: at the distance that its side needs, and not
  // nearer than before the first turn.
  void orbit(double dx_px, double dy_px) {
    if (!shown_) return;
    if (framed_from_ && settings_.view != View::tree) turned_from_ = settings_.camera;
    const std::optional<Camera> first = turned_from_;
    Camera camera = orbited(settings_.camera, dx_px, dy_px, size_);
    if (first) {
      const Vec3d back = normalized(camera.eye - camera.look_at);
      camera.eye = camera.look_at + length(first->eye - first->look_at) * back;
      camera.shorter_side = first->shorter_side;
      camera = far_enough(camera, size_);
    }
    move_to(camera);
    turned_from_ = first;
  }
  Camera far_enough(const Camera& camera, PictureSizePx size) const {
    if (!shown_) return camera;
    return shown_->far_enough(camera, settings_.picture.result().cell_lines.has_value(), size);
  }
  void pan(double dx_px, double dy_px) { move_to(panned(settings_.camera, dx_px, dy_px, size_)); }

  void zoom(double factor, double x_px, double y_px) {
    if (!shown_ || !(std::isfinite(factor) && factor > 0)) return;
    const Camera& camera = settings_.camera;
    move_to(zoomed(camera, factor, seen_at(x_px, y_px), distance_limits(camera, shown_->diagonal)));
  }

  void look_from(ViewFrom side) {
    if (!shown_) return;
    framed_from_ = side;
    turned_from_.reset();
    settings_.camera.fov_deg = chosen_fov_deg_;
    settings_.camera = framed(*shown_, side, settings_, angle_is_users_);
    steps_.moved();
  }

  void home() {
    if (!shown_) return;
    if (!shown_->has_camera) return look_from(ViewFrom::front);
    const Camera& now = settings_.camera;
    Camera camera = shown_->own_camera;
    camera.aperture = 0;
    camera = with_projection(camera, now.projection);
    camera.aperture = now.aperture;
    camera.focus = now.focus;
    move_to(camera);
    chosen_fov_deg_ = shown_->own_camera.fov_deg;
    angle_is_users_ = false;
  }

  // --- Pictures -----------------------------------------------------------------------------------------------

  Result<FrameReport> frame(double budget_ms) {
    drop_picture();
    is_seen_ = true;
    if (shown_) return steps_.frame({*shown_, settings_, size_, gpu_.get()}, budget_ms);
    FrameReport nothing;
    nothing.settled = true;
    nothing.done = 1;
    return nothing;
  }

  const Image& image() const { return steps_.image(); }
  const std::vector<std::uint8_t>& opacity() const { return steps_.opacity(); }

  void show_checks(bool checks) {
    checks_ = checks;
    steps_.show_checks(checks);
    if (gpu_) gpu_->show_checks(checks);
    steps_.start_anew();
  }

  void show(std::uint32_t framebuffer, const GlViewport& viewport) {
    if (gpu_) gpu_->show(framebuffer, viewport);
  }

  // --- A picture to be saved ----------------------------------------------------------------------------------

  Status begin_picture(int width_px, int height_px, int samples_per_pixel) {
    if (!shown_) return bad_setting("there is no scene yet");
    if (Status status = check_picture_memory(width_px, height_px); !status) return status;

    // The picture on the screen is dropped for it.
    drop_picture();
    steps_.drop_step();
    shown_->look_by(settings_);
    Result<PictureToSave> picture = begun_to_save(render_settings(settings_, width_px, height_px, samples_per_pixel));
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

  Result<PngPixels> take_picture() {
    if (!to_save_ || !to_save_->finished()) return bad_setting("no picture to be saved is finished");
    Result<PngPixels> image = to_save_->take();
    drop_picture();
    return image;
  }

  void drop_picture() { to_save_.reset(); }

  Result<PngPixels> picture(int width_px, int height_px, int samples_per_pixel) {
    if (Status status = begin_picture(width_px, height_px, samples_per_pixel); !status) return status.error();
    for (;;) {
      const Result<double> done = advance_picture(kSliceMs);
      if (!done) return done.error();
      if (*done >= 1) return take_picture();
    }
  }

  Result<std::optional<Picked>> pick(double x_px, double y_px) {
    if (!shown_ || settings_.view == View::tree) return std::optional<Picked>();
    const Result<const Tracer*> tracer = shown_->trees->needed_by(settings_);
    if (!tracer) return tracer.error();
    const SphereSet& spheres = (*tracer)->spheres();
    const Camera camera = relative_to(settings_.camera, spheres.origin());
    const Ray ray = PixelRays(camera, size_.width, size_.height).at(x_px, y_px);
    const Hit hit = (*tracer)->closest_hit(ray);
    if (!hit.found() || hit.sphere_id < 0) return std::optional<Picked>();
    const Vec3d local = to_double(ray.origin) + hit.t * to_double(ray.direction);
    // On a stick the sphere at its nearer end.
    const std::int64_t sphere = shown_sphere(shown_->scene, hit.sphere_id);
    return std::optional(Picked{sphere, spheres.in_world(local), length(local - camera.eye)});
  }

  Result<std::string> ray_paths_json(double x_px, double y_px) {
    if (!shown_) return bad_setting("there is no scene yet");
    const Scene& scene = shown_->scene;
    if (has_clips(scene) || scene.spheres.has_images() || scene.cavity_walls != nullptr)
      return bad_setting("paths are those of rays among whole spheres",
                         "leave out clips, copies along the cell, and cavities");
    const Camera camera = relative_to(settings_.camera, scene.spheres.origin());
    Result<std::vector<workbench::StructurePath>> paths =
        shown_->trees->paths_of(PixelRays(camera, size_.width, size_.height).at(x_px, y_px));
    if (!paths) return paths.error();
    for (workbench::StructurePath& path : *paths)
      for (workbench::PathStep& step : path.steps) {
        for (std::int64_t& id : step.sphere_ids) id = input_id(scene, id);
        if (step.best.found()) step.best.sphere_id = input_id(scene, step.best.sphere_id);
      }
    return workbench::ray_paths_json(*paths, scene.name);
  }

  std::string statistics_json() {
    if (!shown_) return statistics_error(bad_setting("there is no scene yet"));
    const Result<std::string> json = shown_->trees->statistics(shown_->scene.seed);
    return json ? *json : statistics_error(json.error());
  }

 private:
  static constexpr double kSliceMs = 100;

  // --- Readiness ----------------------------------------------------------------------------------------------

  Status check_gpu(const ViewerSettings& settings) const {
    if (!gpu_) return bad_setting("there is no graphics processor", "choose the CPU engine");
    if (settings.view == View::tree)
      return bad_setting("the graphics processor does not draw the tree itself", "choose the CPU engine");
    if (settings.picture.result().opacity_rule == OpacityRule::as_one)
      return bad_setting("the graphics processor does not draw overlapping spheres as one",
                         "choose the CPU engine, or another opacity");
    return Done{};
  }

  // Refuse new requests that the picture cannot fulfil.
  Status check_requests(const ViewerSettings& settings) const {
    if (!shown_) return Done{};
    if (!settings.focus_on.empty() && settings.focus_on != settings_.focus_on)
      if (const Result<double> distance = focus_on(shown_->scene.spheres, settings.camera, settings.focus_on);
          !distance)
        return bad_setting("focus: " + distance.error().message, distance.error().hint);
    const Labels before = settings_.picture.result().labels, labels = settings.picture.result().labels;
    if (labels.scale_bar && !before.scale_bar && settings.camera.projection != Projection::orthographic)
      return bad_setting("a perspective picture has no scale: distant spheres look smaller",
                         "choose the projection orthographic for a scale bar");
    if (!labels.legend || before.legend) return Done{};
    RenderSettings picture;
    picture.view = settings.view;
    picture.labels.legend = true;
    return check_labels(shown_->scene, picture);
  }

  // Cameras that differ at most in projection, angle and lens.
  static bool same_place(const Camera& a, const Camera& b) {
    const double shorter_side = with_projection(b, a.projection).shorter_side;
    return a.eye == b.eye && a.look_at == b.look_at && a.up == b.up && a.shorter_side == shorter_side;
  }

  // The layer below the user's settings: the scene's own picture. A lens opened by the user needs more samples.
  static void put_below(const ShownScene& shown, ViewerSettings& settings) {
    PictureSettings& below = settings.picture.below;
    below = shown.scene.picture;
    below.samples_per_pixel = std::min(below.samples_per_pixel, kMostSamples);
    if (leaves_out_fog(settings.picture.result(), settings.picture.user, shown.states_fog)) below.fog.reset();
    if (settings.camera.aperture == 0) return;
    below.adaptive_samples = false;
    if (shown.own_camera.aperture == 0) use_lens_samples(below);
  }

  // Prepares everything for these settings and, if there is one, for the next look of the scene; then shows it.
  // `settings` gets the look's defaults, and with `keeps_side` the camera that shows the whole set. After an Error
  // nothing has changed.
  Status show(std::unique_ptr<ShownScene> next, ViewerSettings& settings, bool keeps_side, bool angle_is_users) {
    const ShownScene& scene = next ? *next : *shown_;
    const bool same_spheres = !next || shown_->same_spheres(*next);
    put_below(scene, settings);
    if (keeps_side) settings.camera = framed(scene, *framed_from_, settings, angle_is_users);

    // The trees refer to the spheres that stay.
    std::unique_ptr<SceneTrees> other_trees;
    const Scene& kept = same_spheres ? shown_->scene : next->scene;
    if (!same_spheres || !same_tree(settings, settings_))
      other_trees = std::make_unique<SceneTrees>(kept, tree_parameters(settings));
    SceneTrees& trees = other_trees ? *other_trees : *shown_->trees;
    const bool upload = next || other_trees || settings_.engine != ViewerEngine::gpu;
    if (Status status = make_ready(scene, trees, settings, upload); !status) return status;

    if (next || other_trees) ++version_;
    drop_picture();
    steps_.drop_step();
    if (next && same_spheres) shown_->take_look_of(std::move(*next));
    if (!same_spheres) shown_ = std::move(next);
    if (other_trees) shown_->trees = std::move(other_trees);
    return Done{};
  }

  // Builds and uploads all that the settings need. After an Error the shown picture is unchanged.
  Status make_ready(const ShownScene& shown, SceneTrees& trees, const ViewerSettings& settings, bool upload) {
    if (settings.engine == ViewerEngine::gpu)
      if (Status status = check_gpu(settings); !status) return status;
    const bool of_tree = settings.view == View::traversal || settings.view == View::tree;
    if (of_tree && has_clips(shown.scene))
      return bad_setting("this view shows the tree of whole spheres", "remove the clips");
    if (of_tree && shown.scene.spheres.has_images())
      return bad_setting("this view shows the tree of the stored spheres", "draw it without copies");
    if (of_tree && shown.scene.cavity_walls != nullptr)
      return bad_setting("this view shows the tree of whole spheres", "choose a scene without cavities");
    if (settings.engine == ViewerEngine::gpu && shown.scene.cavity_walls != nullptr)
      return bad_setting("the graphics processor draws no cavities", "draw on the CPU");
    if (of_tree && !shown.scene.sticks.empty())
      return bad_setting("this view shows the tree of the spheres", "choose a style without bonds");
    if (settings.engine == ViewerEngine::gpu && !shown.scene.sticks.empty())
      return bad_setting("the graphics processor draws no bonds", "draw on the CPU, or in a style without bonds");
    const Result<const Tracer*> tracer = trees.needed_by(settings);
    if (!tracer) return tracer.error();
    if (settings.engine != ViewerEngine::gpu || !upload) return Done{};
    drop_picture();  // it may be the GPU's
    return gpu_->renderer().set_scene(shown.scene, (*tracer)->tree());
  }

  Result<PictureToSave> begun_to_save(const RenderSettings& settings) {
    if (settings_.engine == ViewerEngine::gpu)
      return PictureToSave::by_gpu(*gpu_, shown_->scene, /*new_lights=*/!shown_->has_lights, settings);
    const Result<const Tracer*> tracer = shown_->trees->needed_by(settings_);
    if (!tracer) return tracer.error();
    return PictureToSave::by_cpu(shown_->scene, **tracer, settings);
  }

  // --- Moves --------------------------------------------------------------------------------------------------

  void move_to(const Camera& camera) {
    if (!shown_) return;
    framed_from_.reset();
    turned_from_.reset();
    settings_.camera = camera;
    steps_.moved();
  }

  // As the program places it: with the angle of these settings, which is less in a wide picture unless the user chose
  // it.
  Camera framed(const ShownScene& scene, ViewFrom side, const ViewerSettings& settings, bool angle_is_users) const {
    Camera like = settings.camera;
    if (!angle_is_users) like.fov_deg = angle_for_picture(like.fov_deg, size_.width, size_.height);
    return scene.framed(side, like, settings, size_);
  }

  // The point under (x, y), or a point as far away as look_at.
  Vec3d seen_at(double x_px, double y_px) const {
    const Camera& camera = settings_.camera;
    if (const Tracer* tracer = shown_->trees->any()) {
      const SphereSet& spheres = tracer->spheres();
      const Ray ray = PixelRays(relative_to(camera, spheres.origin()), size_.width, size_.height).at(x_px, y_px);
      const Hit hit = tracer->closest_hit(ray);
      if (hit.found()) return spheres.in_world(to_double(ray.origin) + hit.t * to_double(ray.direction));
    }
    return point_under(camera, x_px, y_px, size_);
  }

  std::optional<SceneInput> input_;
  ViewerLook look_;
  std::unique_ptr<ShownScene> shown_;  // the input with this look
  std::unique_ptr<GpuPictures> gpu_;
  ViewerSettings settings_;
  PictureSizePx size_{1280, 720};
  std::optional<ViewFrom> framed_from_;       // the camera shows the whole set from there, as look_from() placed it
  std::optional<Camera> turned_from_;         // only turns and cuts since then: the camera before
  bool is_seen_ = false;                      // a frame of this scene was asked for
  double chosen_fov_deg_ = Camera{}.fov_deg;  // by the scene or the user, not by a change of the projection
  bool angle_is_users_ = false;               // not the scene's
  std::shared_ptr<const FrameMaker> maker_;
  std::uint64_t maker_version_ = 0;
  std::uint64_t version_ = 0;  // of all that goes into a frame: look, copies, trees
  bool checks_ = true;
  PictureSteps steps_;
  std::optional<PictureToSave> to_save_;
};

Viewer::Viewer() : implementation_(std::make_unique<Implementation>()) {}
Viewer::~Viewer() = default;

Result<SceneFacts> Viewer::load_built_in(const std::string& name, const ScenarioParameters& parameters,
                                         const ReadOptions& options) {
  return implementation_->load(SceneInput::built_in(name, parameters, options));
}
Result<SceneFacts> Viewer::load(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return implementation_->load(SceneInput::file(bytes, name, options));
}
Result<SceneFacts> Viewer::load(SphereFile spheres, const std::string& name) {
  return implementation_->load(SceneInput::spheres(std::move(spheres), name));
}
Result<SceneFacts> Viewer::load(Scene scene, SceneFacts facts, bool has_camera, bool has_lights) {
  return implementation_->load(SceneInput::made(std::move(scene), std::move(facts), has_camera, has_lights));
}
const SceneFacts& Viewer::facts() const {
  return implementation_->facts();
}
const Scene& Viewer::scene() const {
  return implementation_->scene();
}
const SphereSet& Viewer::input_spheres() const {
  return implementation_->input_spheres();
}

const ViewerLook& Viewer::look() const {
  return implementation_->look();
}
Result<std::vector<std::int64_t>> Viewer::set_look(const ViewerLook& look, std::size_t* failed_row) {
  return implementation_->set_look(look, failed_row);
}

std::shared_ptr<const FrameMaker> Viewer::frame_maker() const {
  return implementation_->frame_maker();
}
Result<bool> Viewer::show_frame(PreparedFrame& frame) {
  return implementation_->show_frame(frame);
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
Camera Viewer::far_enough(const Camera& camera, int width_px, int height_px) const {
  return implementation_->far_enough(camera, {width_px, height_px});
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
const std::vector<std::uint8_t>& Viewer::opacity() const {
  return implementation_->opacity();
}
void Viewer::show_checks(bool checks) {
  implementation_->show_checks(checks);
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
Result<PngPixels> Viewer::take_picture() {
  return implementation_->take_picture();
}
void Viewer::drop_picture() {
  implementation_->drop_picture();
}
Result<PngPixels> Viewer::picture(int width_px, int height_px, int samples_per_pixel) {
  return implementation_->picture(width_px, height_px, samples_per_pixel);
}
Result<std::optional<Picked>> Viewer::pick(double x_px, double y_px) const {
  return implementation_->pick(x_px, y_px);
}
Result<std::string> Viewer::ray_paths_json(double x_px, double y_px) const {
  return implementation_->ray_paths_json(x_px, y_px);
}
std::string Viewer::statistics_json() const {
  return implementation_->statistics_json();
}

}  // namespace bihive
