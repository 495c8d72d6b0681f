#include "page.h"

#include <emscripten/bind.h>
#include <emscripten/html5_webgl.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "answers.h"
#include "bihive/base/json_text.h"
#include "bihive/base/setting_name.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/measures.h"
#include "bihive/io/frames.h"
#include "bihive/io/reading_settings.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/names.h"
#include "bihive/viewer/contents.h"
#include "bihive/viewer/load_file.h"
#include "bihive/viewer/shown_measures.h"
#include "bihive/viewer/viewer_json.h"
#include "control_names.h"

namespace bihive::page {
namespace {

using nlohmann::ordered_json;

std::string done_or(const Status& status) {
  return status ? "{}" : failure(status.error());
}

// JavaScript's largest whole number; memory allows fewer spheres.
constexpr double kMostSpheres = 9007199254740991;

// The attributes that colour the spheres, for the text beside the controls. A continuous map has a range.
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

}  // namespace

std::string Page::folder() {
  return std::string(kFolder);
}

std::string Page::loaded(const Result<SceneFacts>& facts) const {
  if (!facts) return failure(facts.error());
  ordered_json json;
  json["facts"] = {{"name", facts->name},
                   {"title", facts->title},
                   {"entry_id", facts->entry_id},
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
                   {"attributes", facts->attributes},
                   {"length_unit", viewer_.scene().length_unit}};
  json["settings"] = *json_from_text<ordered_json>(settings());
  json["look"] = *json_from_text<ordered_json>(look());
  json["coloured_by"] = coloured_by_json(viewer_.scene());
  return text_of(json);
}

std::string Page::load(const std::string& name, const std::string& trajectory, const std::string& how) {
  return with_memory([&] {
    const Result<GivenReading> given = reading_from_json(how);
    if (!given) return failure(given.error());
    ReadOptions reading = given->options();
    if (!trajectory.empty()) reading.trajectory = folder() + trajectory;
    Result<LoadedFile> file = load_file(viewer_, folder() + name, reading);
    if (!file) return failure(file.error());
    frames_ = std::move(file->frames);
    start_player(reading.frame);
    return loaded(file->facts);
  });
}

// --- The player -------------------------------------------------------------------------------------------------

void Page::start_player(std::int64_t frame) {
  const std::int64_t count = frames_ ? frames_->count() : 1;
  frame_in_viewer_ = frames_ ? numbered_frame(frame, count) : 0;
  player_.start_anew(count, frame_in_viewer_);
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
                  {"time_ps", time_ps ? ordered_json(*time_ps) : ordered_json()},
                  {"title", viewer_.facts().title}});
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

std::string Page::load_built_in(const std::string& name, double count, const std::string& how) {
  return with_memory([&] {
    const Result<GivenReading> given = reading_from_json(how);
    if (!given) return failure(given.error());
    const ReadOptions reading = given->options();
    ScenarioParameters parameters;
    if (count != 0) {
      if (!(count >= 1 && count <= kMostSpheres && count == std::floor(count)))
        return failure({"the number of spheres must be a whole number from 1", name, 0, 0, ""});
      parameters.count = static_cast<std::int64_t>(count);
    }
    if (reading.radius) parameters.radius = scenario_radius(*reading.radius);
    const Result<SceneFacts> facts = viewer_.load_built_in(name, parameters, reading);
    if (facts) frames_.reset();
    if (facts) start_player(0);
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

std::string Page::far_enough(const std::string& camera, int width_px, int height_px) const {
  return with_memory([&] {
    Result<ViewerSettings> settings = settings_from_json(camera, viewer_.settings());
    if (!settings) return failure(settings.error());
    if (const Status status = check_camera(settings->camera); !status) return failure(status.error());
    settings->camera = viewer_.far_enough(settings->camera, width_px, height_px);
    return settings_to_json(*settings);
  });
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

std::string Page::take_image() {
  const Image& image = viewer_.image();
  pixels_ = pixels_of(image);
  const std::vector<std::uint8_t>& opacity = viewer_.opacity();
  for (std::size_t i = 0; i < opacity.size(); ++i) pixels_[4 * i + 3] = opacity[i];
  return text_of({{"width", image.width}, {"height", image.height}});
}

std::string Page::pick(double x_px, double y_px) const {
  return with_memory([&] {
    const Result<std::optional<Picked>> picked = viewer_.pick(x_px, y_px);
    if (!picked) return failure(picked.error());
    return *picked ? picked_json(**picked) : text_of({{"picked", nullptr}});
  });
}

std::string Page::ray_paths(double x_px, double y_px) const {
  return with_memory([&] {
    const Result<std::string> json = viewer_.ray_paths_json(x_px, y_px);
    return json ? *json : failure(json.error());
  });
}

std::string Page::picked_json(const Picked& picked) const {
  auto json = *json_from_text<ordered_json>(picked_to_json(picked, viewer_.scene()));
  json["sphere"] = input_id(viewer_.scene(), picked.sphere);
  return text_of({{"picked", json}});
}

std::optional<std::int64_t> Page::stored_id(double id) const {
  if (!(id >= 0 && id < kMostSpheres)) return std::nullopt;
  return shown_id(viewer_.scene(), static_cast<std::int64_t>(id));
}

std::string Page::sphere(double id) const {
  return with_memory([&] {
    const std::optional<std::int64_t> sphere = stored_id(id);
    return sphere ? picked_json({*sphere, viewer_.scene().spheres.centre(*sphere)}) : text_of({{"picked", nullptr}});
  });
}

std::string Page::measured(const emscripten::val& ids) const {
  return with_memory([&] {
    const SphereSet& spheres = viewer_.scene().spheres;
    std::vector<std::int64_t> of;
    for (const double id : emscripten::vecFromJSArray<double>(ids))
      if (const std::optional<std::int64_t> sphere = stored_id(id)) of.push_back(*sphere);
    const std::optional<Lattice> lattice = Lattice::of(spheres.cell());
    ordered_json value;
    bool nearest_images = false;
    if (of.size() >= 2 && of.size() <= 4)
      if (const double measure = bihive::measured(spheres, of, lattice); std::isfinite(measure)) {
        value = measure;
        nearest_images = lattice.has_value() && measure != bihive::measured(spheres, of, std::nullopt);
      }
    return text_of({{"value", value}, {"nearest_images", nearest_images}});
  });
}

std::string Page::measured_in(double frame, const emscripten::val& ids) const {
  return with_memory([&] {
    const auto number = static_cast<std::int64_t>(frame);
    std::optional<SphereFile> file;
    if (frames_) {
      Result<SphereFile> read = frames_->read(number);
      if (!read) return failure(read.error());
      file = std::move(*read);
    }
    const SphereSet& spheres = file ? file->spheres : viewer_.input_spheres();
    std::vector<std::int64_t> of;
    for (const double id : emscripten::vecFromJSArray<double>(ids)) {
      if (!(id >= 0 && id < double(spheres.size())))
        return failure({fmt::format("frame {} has no sphere {}", number, id), "", 0, 0, ""});
      of.push_back(static_cast<std::int64_t>(id));
    }
    if (of.size() < 2 || of.size() > 4) return failure({"a measure is of two to four spheres", "", 0, 0, ""});
    const double value = bihive::measured(spheres, of, Lattice::of(spheres.cell()));
    const auto shown = [](const auto& known) { return known ? fmt::format("{}", *known) : std::string(); };
    const std::string time = shown(file ? file->time_ps : std::optional<double>());
    const std::string step = shown(file ? file->step : std::optional<std::int64_t>());
    return text_of({{"line", fmt::format("{},{},{},{}", number, time, step,
                                         std::isnan(value) ? std::string("nan") : fmt::format("{:.9g}", value))}});
  });
}

std::string Page::measures(const std::string& selection, double probe) const {
  return with_memory([&] {
    const Result<std::string> json = shown_measures_to_json(viewer_.scene(), viewer_.input_spheres(), selection, probe);
    return json ? *json : failure(json.error());
  });
}

std::string Page::contents() const {
  return with_memory([&] { return contents_to_json(viewer_.input_spheres()); });
}

std::string Page::legend() const {
  return with_memory([&] { return legend_to_json(viewer_.scene()); });
}

std::string Page::histogram(const std::string& attribute, int bins) const {
  return with_memory([&] {
    const Result<std::string> json = histogram_to_json(viewer_.input_spheres(), attribute, bins);
    return json ? *json : failure(json.error());
  });
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

}  // namespace bihive::page

EMSCRIPTEN_BINDINGS(page) {
  bihive::name_settings_by(&bihive::page::control_name);
  using bihive::page::Page;
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
      .function("far_enough", &Page::far_enough)
      .function("attach_gl", &Page::attach_gl)
      .function("detach_gl", &Page::detach_gl)
      .function("frame", &Page::frame)
      .function("take_image", &Page::take_image)
      .function("pixels", &Page::pixels)
      .function("let_page_through", &Page::let_page_through)
      .function("pick", &Page::pick)
      .function("sphere", &Page::sphere)
      .function("measured", &Page::measured)
      .function("measured_in", &Page::measured_in)
      .function("measures", &Page::measures)
      .function("contents", &Page::contents)
      .function("legend", &Page::legend)
      .function("histogram", &Page::histogram)
      .function("show", &Page::show)
      .function("begin_picture", &Page::begin_picture)
      .function("step_picture", &Page::step_picture)
      .function("take_picture", &Page::take_picture)
      .function("drop_picture", &Page::drop_picture)
      .function("ray_paths", &Page::ray_paths)
      .function("statistics", &Page::statistics);
}
