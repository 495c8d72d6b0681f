#include "page.h"

#include <emscripten/bind.h>
#include <emscripten/html5_webgl.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/base/parallel.h"
#include "bihive/base/version.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/colour_maps.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/named_materials.h"
#include "bihive/scene/names.h"
#include "bihive/scene/style.h"
#include "bihive/thesis/builtin_values.h"
#include "bihive/thesis/frame_rates_report.h"
#include "bihive/thesis/stated_values.h"
#include "bihive/viewer/load_file.h"
#include "bihive/viewer/viewer_json.h"

namespace bihive::page {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kFolder = "/files-of-the-user/";

// Nobody knows the folder but this module and its worker.
std::string text_of(const ordered_json& json) {
  std::string text = json.dump(-1, ' ', /*ensure_ascii=*/false, ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find(kFolder); at != std::string::npos; at = text.find(kFolder, at))
    text.erase(at, kFolder.size());
  return text;
}

ordered_json failure_json(const Error& error) {
  return {{"error",
           {{"message", error.message},
            {"file", error.file},
            {"line", error.line},
            {"column", error.column},
            {"hint", error.hint}}}};
}

std::string failure(const Error& error) {
  return text_of(failure_json(error));
}

template <class T>
ordered_json names_json(const Names<T>& names) {
  ordered_json list = ordered_json::array();
  for (const auto& named : names) list.push_back(named.first);
  return list;
}

Result<StatedValues> stated_values() {
  return StatedValues::parse(builtin_values_figure_4_4(), "thesis/figure-4.4/values.json");
}

// A full run of the thesis ends in about ten minutes, a quick one in about one: slower devices draw smaller pictures.
constexpr double kThesisSeconds = 600, kQuickThesisSeconds = 60;

MeasuringDevice device_from(const std::string& text) {
  const Result<ordered_json> json = json_from_text<ordered_json>(text);
  MeasuringDevice device;
  if (!json || !json->is_object()) return device;
  for (const auto& [name, value] : json->items()) {
    if (!value.is_string()) continue;
    if (name == "device")
      device.words = value.get<std::string>();
    else
      device.facts.emplace_back(name, value.get<std::string>());
  }
  return device;
}

std::string done_or(const Status& status) {
  return status ? "{}" : failure(status.error());
}

// JavaScript's largest whole number; memory allows fewer spheres.
constexpr double kMostSpheres = 9007199254740991;

// A radius below 0: the file's own.
ReadOptions reading_of(double radius, double radius_scale) {
  ReadOptions reading;
  if (radius >= 0) reading.radius = radius;
  reading.radius_scale = radius_scale;
  return reading;
}

// What colours the spheres: for the words beside the controls. A continuous map has a range.
ordered_json coloured_by_json(const Scene& scene) {
  ordered_json list = ordered_json::array();
  for (const ColourBy& how : scene.coloured_by) {
    ordered_json one;
    one["attribute"] = how.attribute;
    if (how.range) one["range"] = {how.range->first, how.range->second};
    list.push_back(std::move(one));
  }
  return list;
}

// Lack of memory is the only failure that throws.
template <class Work>
std::string with_memory(const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failure({"there is not enough memory for this in the browser", "", 0, 0, "try a smaller file or picture"});
  }
}

}  // namespace

std::string Page::folder() {
  return std::string(kFolder);
}

std::string Page::loaded(const Result<SceneFacts>& facts) const {
  if (!facts) return failure(facts.error());
  ordered_json json;
  json["facts"] = {{"name", facts->name},
                   {"format", facts->format},
                   {"spheres", facts->spheres},
                   {"frames", facts->frames},
                   {"rules", facts->rules},
                   {"warnings", facts->warnings},
                   {"takes_style", facts->takes_style},
                   {"is_file_of_spheres", facts->is_file_of_spheres},
                   {"has_elements", facts->has_elements},
                   {"has_cell", facts->has_cell},
                   {"copies", facts->copies},
                   {"attributes", facts->attributes}};
  json["settings"] = *json_from_text<ordered_json>(settings());
  json["look"] = *json_from_text<ordered_json>(look());
  json["coloured_by"] = coloured_by_json(viewer_.scene());
  return text_of(json);
}

std::string Page::load(const std::string& name, const std::string& trajectory, double radius, double radius_scale,
                       const std::string& columns) {
  return with_memory([&] {
    ReadOptions reading = reading_of(radius, radius_scale);
    if (!columns.empty()) {
      Result<ColumnChoice> choice = columns_from_text(columns);
      if (!choice) return failure(choice.error());
      reading.columns = std::move(*choice);
    }
    if (!trajectory.empty()) reading.trajectory = folder() + trajectory;
    Result<LoadedFile> file = load_file(viewer_, folder() + name, reading);
    if (!file) return failure(file.error());
    frames_ = std::move(file->frames);
    start_player();
    return loaded(file->facts);
  });
}

// --- The player -------------------------------------------------------------------------------------------------

void Page::start_player() {
  player_.start_anew(frames_ ? frames_->count() : 1);
  frame_in_viewer_ = 0;
  frame_is_drawn_ = true;
}

std::string Page::player() const {
  const std::optional<double> time_ps = viewer_.facts().time_ps;
  return text_of({{"frames", player_.frames()},
                  {"frame", player_.frame()},
                  {"shown", player_.is_shown()},
                  {"playing", player_.playing()},
                  {"loops", player_.loops()},
                  {"frames_per_second", player_.frames_per_second()},
                  {"time_ps", time_ps ? ordered_json(*time_ps) : ordered_json()}});
}

void Page::toggle_play(double now_ms) {
  if (player_.playing())
    player_.pause();
  else
    player_.play(now_ms);
}

void Page::go_to_frame(double frame) {
  if (frame >= 0 && frame < double(player_.frames())) player_.go_to(static_cast<std::int64_t>(frame));
}

std::string Page::continue_playing(double now_ms) {
  return with_memory([&] {
    if (!frames_) return std::string("{}");
    player_.advance(now_ms);
    const std::int64_t frame = player_.frame();
    if (frame == frame_in_viewer_) {
      if (frame_is_drawn_) player_.shown(now_ms);
      return std::string("{}");
    }
    const Status shown = show_frame(frame);
    if (shown) return std::string("{}");
    player_.start_anew(player_.frames(), frame_in_viewer_);
    return failure(shown.error());
  });
}

Status Page::show_frame(std::int64_t frame) {
  Result<SphereFile> read = frames_->read(frame);
  if (!read) return read.error();
  Result<std::shared_ptr<PreparedFrame>> made = viewer_.frame_maker()->make(std::move(*read));
  if (!made) return made.error();
  if (const Result<bool> shown = viewer_.show_frame(**made); !shown) return shown.error();
  frame_in_viewer_ = frame;
  frame_is_drawn_ = false;
  return Done{};
}

std::string Page::load_built_in(const std::string& name, double count, double radius, double radius_scale) {
  return with_memory([&] {
    ScenarioParameters parameters;
    if (count != 0) {
      if (!(count >= 1 && count <= kMostSpheres && count == std::floor(count)))
        return failure({"the number of spheres must be a whole number from 1", name, 0, 0, ""});
      parameters.count = static_cast<std::int64_t>(count);
    }
    if (radius >= 0) parameters.radius = scenario_radius(radius);
    const Result<SceneFacts> facts = viewer_.load_built_in(name, parameters, reading_of(radius, radius_scale));
    if (facts) frames_.reset();
    if (facts) start_player();
    return loaded(facts);
  });
}

std::string Page::settings() const {
  return settings_to_json(viewer_.settings());
}

std::string Page::set(const std::string& changes) {
  return with_memory([&] {
    const Result<ViewerSettings> settings = settings_from_json(changes, viewer_.settings());
    return settings ? done_or(viewer_.set(*settings)) : failure(settings.error());
  });
}

std::string Page::choices() const {
  ordered_json json;
  for (const std::string& name : style_names())
    json["styles"].push_back({{"name", name}, {"description", style_named(name)->description}});
  json["actions"] = look_action_names();
  json["maps"] = kColourMapNames;
  json["materials"] = names_json(named_materials());
  json["lights"] = names_json(light_presets());
  json["settings"] = *json_from_text<ordered_json>(parameters_to_json());
  json["tones"] = names_of(*parameter_named("tone"));
  return text_of(json);
}

std::string Page::look() const {
  return viewer_look_to_json(viewer_.look());
}

std::string Page::set_look(const std::string& changes) {
  return with_memory([&] {
    const Result<ViewerLook> look = viewer_look_from_json(changes, viewer_.look());
    if (!look) return failure(look.error());
    std::size_t row = look->rows.size();
    const Result<std::vector<std::int64_t>> counts = viewer_.set_look(*look, &row);
    if (counts) return text_of({{"counts", *counts}, {"coloured_by", coloured_by_json(viewer_.scene())}});
    ordered_json json = failure_json(counts.error());
    json["error"]["row"] = row < look->rows.size() ? static_cast<int>(row) : -1;
    return text_of(json);
  });
}

std::string Page::look_from(const std::string& side) {
  for (const auto& [name, from] : kSides)
    if (name == side) {
      viewer_.look_from(from);
      return "{}";
    }
  return failure({"there is no side \"" + side + "\"", "", 0, 0, ""});
}

std::string Page::attach_gl() {
  return with_memory([&] {
    if (emscripten_webgl_get_current_context() == 0) return failure({"no WebGL2 context is current", "", 0, 0, ""});
    const Status status = viewer_.attach_gl(browser_gl_functions());
    return status ? text_of({{"description", viewer_.gl_description()}}) : failure(status.error());
  });
}

std::string Page::frame(double budget_ms) {
  return with_memory([&] {
    const Result<FrameReport> report = viewer_.frame(budget_ms);
    if (!report) return failure(report.error());
    if (report->drawn) frame_is_drawn_ = true;
    return text_of({{"drawn", report->drawn},
                    {"settled", report->settled},
                    {"done", report->done},
                    {"divisor", report->divisor},
                    {"frame_ms", report->frame_ms},
                    {"fps", report->fps},
                    {"mray_per_s", report->mray_per_s}});
  });
}

void Page::take_pixels(const Image& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  pixels_.resize(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) pixels_[4 * i + channel] = image.rgb[3 * i + channel];
    pixels_[4 * i + 3] = 255;
  }
}

std::string Page::take_image() {
  const Image& image = viewer_.image();
  take_pixels(image);
  return text_of({{"width", image.width}, {"height", image.height}});
}

emscripten::val Page::pixels() const {
  return emscripten::val(emscripten::typed_memory_view(pixels_.size(), pixels_.data()));
}

void Page::show(int width_px, int height_px) {
  viewer_.show(0, {0, 0, width_px, height_px});
}

std::string Page::begin_picture(int width_px, int height_px, int samples_per_pixel) {
  return with_memory([&] { return done_or(viewer_.begin_picture(width_px, height_px, samples_per_pixel)); });
}

std::string Page::step_picture(double budget_ms) {
  return with_memory([&] {
    const Result<double> done = viewer_.advance_picture(budget_ms);
    return done ? text_of({{"done", *done}}) : failure(done.error());
  });
}

std::string Page::take_picture() {
  return with_memory([&] {
    Result<PngPixels> picture = viewer_.take_picture();
    if (!picture) return failure(picture.error());
    pixels_ = std::move(picture->bytes);
    return text_of({{"width", picture->width}, {"height", picture->height}, {"channels", picture->channels}});
  });
}

std::string Page::begin_thesis(bool quick, const std::string& saved) {
  return with_memory([&] {
    const Result<StatedValues> values = stated_values();
    if (!values) return failure(values.error());
    Result<FrameRatePlan> plan = FrameRatePlan::from_values(*values);
    if (!plan) return failure(plan.error());
    if (quick) plan = plan->quickly();
    end_thesis();
    if (viewer_.settings().engine == ViewerEngine::gpu) {
      Result<GlRenderer> renderer = GlRenderer::create(browser_gl_functions());
      if (!renderer) return failure(renderer.error());
      thesis_gl_ = std::move(*renderer);
    }
    FrameEngine engine;
    engine.gl = thesis_gl_ ? &*thesis_gl_ : nullptr;
    const std::optional<SavedFrameRates> earlier = saved_frame_rates(saved);
    const bool same = earlier && earlier->engine == thesis_engine() && earlier->quick == quick &&
                      earlier->rounds == plan->rounds && earlier->width_px <= plan->width_px;
    if (same) {
      plan->width_px = earlier->width_px;
      plan->height_px = earlier->height_px;
    } else {
      plan = plan->within(quick ? kQuickThesisSeconds : kThesisSeconds, engine);
      if (!plan) return failure(plan.error());
    }
    thesis_.emplace(*plan, engine);
    if (same) thesis_->resume(earlier->rates);
    return text_of(
        {{"width_px", plan->width_px}, {"height_px", plan->height_px}, {"resumed", thesis_->rates().size()}});
  });
}

std::string Page::step_thesis() {
  return with_memory([&] {
    if (!thesis_) return failure({"no run of the thesis has begun", "", 0, 0, ""});
    if (const Status status = thesis_->step(); !status) return failure(status.error());
    return text_of({{"finished", thesis_->finished()},
                    {"done", thesis_->done()},
                    {"seconds_left", thesis_->seconds_left()},
                    {"configurations_done", thesis_->rates().size()},
                    {"configurations", thesis_->plan().configurations()},
                    {"scenario", thesis_->scenario()},
                    {"spheres", thesis_->spheres()}});
  });
}

std::string Page::thesis_so_far(const std::string& device) const {
  return with_memory([&] {
    if (!thesis_) return failure({"no run of the thesis has begun", "", 0, 0, ""});
    const Result<StatedValues> values = stated_values();
    if (!values) return failure(values.error());
    std::optional<MeasuredCosts> costs;
    if (thesis_->finished()) {
      Result<MeasuredCosts> measured = measured_costs(*thesis_, *values, thesis_gl_ ? 1 : hardware_threads());
      if (!measured) return failure(measured.error());
      costs = std::move(*measured);
    }
    const MeasuredCosts* const known = costs ? &*costs : nullptr;
    ordered_json json;
    json["result"] = frame_rates_json(*thesis_, *values, thesis_engine(), device_from(device), known);
    json["charts"] = frame_rates_charts(*thesis_, *values, "this device", known);
    return text_of(json);
  });
}

void Page::end_thesis() {
  thesis_.reset();
  thesis_gl_.reset();
}

std::string Page::begin_shown_frames(double seconds) {
  return with_memory([&] {
    const Result<StatedValues> values = stated_values();
    if (!values) return failure(values.error());
    Result<ShownFramesPlan> plan = ShownFramesPlan::from_values(*values);
    if (!plan) return failure(plan.error());
    plan->measure_for(seconds);
    shown_frames_.emplace(std::move(*plan));
    return std::string("{}");
  });
}

std::string Page::draw_shown_frame() {
  return with_memory([&] {
    if (!shown_frames_) return failure({"no frames are measured", "", 0, 0, ""});
    const Result<const Image*> image = shown_frames_->draw();
    if (!image) return failure(image.error());
    take_pixels(**image);
    return text_of({{"width", (*image)->width}, {"height", (*image)->height}});
  });
}

std::string Page::frame_is_shown(double now_ms) {
  return with_memory([&] {
    if (!shown_frames_) return failure({"no frames are measured", "", 0, 0, ""});
    shown_frames_->shown(now_ms);
    const std::vector<ShownRate>& rates = shown_frames_->rates();
    const ShownRate& now = rates[std::min(shown_frames_->measured(), rates.size() - 1)];
    return text_of({{"finished", shown_frames_->finished()},
                    {"done", static_cast<double>(shown_frames_->measured()) / static_cast<double>(rates.size())},
                    {"scenario", now.scenario},
                    {"spheres", now.spheres},
                    {"max_prims", now.max_prims ? ordered_json(*now.max_prims) : ordered_json()},
                    {"turning", now.turning}});
  });
}

std::string Page::end_shown_frames(const std::string& device) {
  return with_memory([&] {
    if (!shown_frames_) return failure({"no frames are measured", "", 0, 0, ""});
    ordered_json json;
    json["result"] = shown_frames_->json("page", device_from(device).words);
    shown_frames_.reset();
    return text_of(json);
  });
}

}  // namespace bihive::page

namespace {

std::string version_text() {
  const std::string commit(bihive::commit());
  return std::string(bihive::version()) + (commit.empty() ? "" : " (" + commit + ")");
}

}  // namespace

EMSCRIPTEN_BINDINGS(page) {
  using bihive::page::Page;
  emscripten::function("version", &version_text);
  emscripten::function("threads", &bihive::hardware_threads);
  emscripten::class_<Page>("Page")
      .constructor<>()
      .class_function("folder", &Page::folder)
      .function("player", &Page::player)
      .function("toggle_play", &Page::toggle_play)
      .function("step_frames", &Page::step_frames)
      .function("go_to_frame", &Page::go_to_frame)
      .function("set_frames_per_second", &Page::set_frames_per_second)
      .function("set_loops", &Page::set_loops)
      .function("continue_playing", &Page::continue_playing)
      .function("load", &Page::load)
      .function("load_built_in", &Page::load_built_in)
      .function("settings", &Page::settings)
      .function("set", &Page::set)
      .function("resize", &Page::resize)
      .function("orbit", &Page::orbit)
      .function("pan", &Page::pan)
      .function("zoom", &Page::zoom)
      .function("choices", &Page::choices)
      .function("look", &Page::look)
      .function("set_look", &Page::set_look)
      .function("look_from", &Page::look_from)
      .function("home", &Page::home)
      .function("attach_gl", &Page::attach_gl)
      .function("detach_gl", &Page::detach_gl)
      .function("frame", &Page::frame)
      .function("take_image", &Page::take_image)
      .function("pixels", &Page::pixels)
      .function("show", &Page::show)
      .function("begin_picture", &Page::begin_picture)
      .function("step_picture", &Page::step_picture)
      .function("take_picture", &Page::take_picture)
      .function("drop_picture", &Page::drop_picture)
      .function("statistics", &Page::statistics)
      .function("begin_thesis", &Page::begin_thesis)
      .function("step_thesis", &Page::step_thesis)
      .function("thesis_so_far", &Page::thesis_so_far)
      .function("end_thesis", &Page::end_thesis)
      .function("begin_shown_frames", &Page::begin_shown_frames)
      .function("draw_shown_frame", &Page::draw_shown_frame)
      .function("frame_is_shown", &Page::frame_is_shown)
      .function("end_shown_frames", &Page::end_shown_frames);
}
