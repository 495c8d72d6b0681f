#include "film/fix_film.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/io/data_path.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/prepare_picture.h"
#include "commands/names.h"
#include "film/fit_frames.h"
#include "film/frame_motions.h"
#include "film/turning_camera.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

// Duration in seconds of a film that shows one frame from all sides.
constexpr double kSecondsOfTurn = 10;

// Identifies a file by its path, size and time; anything else by its name.
ordered_json described_file(const std::string& path) {
  ordered_json object = {{"path", path}};
  struct stat found {};
  if (is_built_in_scene(path) || stat(data_path(path).file.c_str(), &found) != 0 || !S_ISREG(found.st_mode))
    return object;
  object["bytes"] = static_cast<std::int64_t>(found.st_size);
  object["changed_s"] = static_cast<std::int64_t>(found.st_mtim.tv_sec);
  object["changed_ns"] = static_cast<std::int64_t>(found.st_mtim.tv_nsec);
  return object;
}

void widen(ColourRange& range, const ColourRange& other) {
  if (!other) return;
  if (!range) range = other;
  range->first = std::min(range->first, other->first);
  range->second = std::max(range->second, other->second);
}

// The ranges of all frames of the film.
void widen_over_film(const FrameSource& source, const FilmPlan& plan, const FilmOptions& options, const Style& style,
                     FilmPlan::Fixed& fixed) {
  Progress progress("ranges of colours");
  for (std::int64_t k = 1; k < plan.asked.frames.count; ++k) {
    CancellableSection::leave_if_cancelled();
    Input input = source.load(plan.asked.frames.frame(k), style);
    if (const SettingValue* const transfer = options.picture.picture.find("transfer"))
      parameter_named("transfer")->set(input.scene.picture, *transfer);
    look(input, options.picture.looks, {}, /*may_be_empty=*/true);
    if (input.scene.spheres.empty()) continue;
    widen(fixed.range_of_style, range_of_style(input, options.picture.looks));
    const std::vector<ColourRange> ranges = ranges_of_looks(input, options.picture.looks);
    for (std::size_t i = 0; i < std::min(ranges.size(), fixed.ranges_of_looks.size()); ++i)
      widen(fixed.ranges_of_looks[i], ranges[i]);
    progress.update(static_cast<double>(k) / static_cast<double>(plan.asked.frames.count));
  }
}

// The first of the film's frames of which something is to be seen, and what it holds. If all spheres of all frames are
// hidden, the first one, whose error says so.
std::pair<std::int64_t, Input> first_shown_frame(const FrameSource& source, const FilmPlan& plan,
                                                 const FilmOptions& options, const Style& style) {
  std::int64_t shown = -1;
  for (std::int64_t k = 0; k < plan.asked.frames.count; ++k) {
    CancellableSection::leave_if_cancelled();
    const std::int64_t frame = plan.asked.frames.frame(k);
    Input input = source.load(frame, style);
    if (input.scene.spheres.empty()) continue;
    if (options.picture.looks.looks.empty() && input.looks.empty()) return {frame, std::move(input)};
    if (shown < 0) shown = frame;
    look(input, options.picture.looks, {}, /*may_be_empty=*/true);
    if (input.scene.spheres.empty()) continue;
    shown = frame;
    break;
  }
  if (shown < 0) fail({"there are no spheres in the frames of the film", options.picture.input.input, 0, 0, ""});
  return {shown, source.load(shown, style)};
}

// Unset: the picture's vertical. The default is the up direction of the chosen side, or that of a camera that the scene
// or the user states.
std::optional<Vec3d> axis_of_turntable(const Input& input, const Camera& camera, const FilmOptions& options) {
  const RenderOptions& picture = options.picture;
  const bool is_fitted = !input.has_camera || picture.view_from || picture.view_of || picture.fit;
  std::optional<Vec3d> axis;
  if (options.turn_axis == "x") axis = {1, 0, 0};
  if (options.turn_axis == "y") axis = {0, 1, 0};
  if (options.turn_axis == "z") axis = {0, 0, 1};
  if (options.turn_axis.empty()) {
    if (picture.up || !is_fitted)
      axis = normalized(picture.up.value_or(camera.up));
    else if (!picture.view_of)
      axis = side_of(picture.view_from.value_or(ViewFrom::front)).up;
  }
  if (axis && *axis == camera.up) axis.reset();
  return axis;
}

void check_fit_of_frames(const FilmPlan& plan, const FilmOptions& options, const Input& input,
                         const RenderSettings& settings) {
  const RenderOptions& picture = options.picture;
  const std::string value = " " + name_of(kFittedFrames, options.fit_frames);
  const bool user_places = picture.eye || picture.look_at || picture.up || picture.fit || picture.zoom_to;
  if (user_places || (input.has_camera && !picture.view_from && !picture.view_of))
    fail_setting("fit_frames", value + " is for a camera that bihive places, and this one is stated",
                 "leave one of them out");
  if (plan.asked.path.moves())
    fail_setting("fit_frames", value + " is for a camera that does not turn", "leave one of them out");
  if (settings.view == View::tree)
    fail_setting("fit_frames", value + " is for pictures of spheres, and " + setting_name("view") + " tree is none",
                 "leave one of them out");
  if (options.fit_frames == FittedFrames::each && (picture.view_of || !options.follow.empty()))
    fail_setting("fit_frames",
                 value + " moves the camera in each picture, and so does " +
                     setting_name(picture.view_of ? "view_from" : "follow"),
                 "leave one of them out");
}

}  // namespace

FilmPlan::Asked film_asked_for(const FilmOptions& options, std::int64_t frames) {
  FilmPlan::Asked asked;
  asked.program = version();
  asked.input = {described_file(options.picture.input.input)};
  for (const GivenSetting& file : files_named_by(options.picture)) asked.input.push_back(described_file(file.value));
  const Result<FrameList> list = frames_in(options.frames.value_or(FrameRange{}), frames);
  if (!list) fail_setting("frames", ": " + list.error().message, list.error().hint);
  asked.frames = *list;
  asked.rate = options.rate;
  asked.options = options.words;
  asked.path.turntable_deg = options.turntable_deg;
  asked.path.keys = options.keys;
  if (!options.camera_keys.empty())
    asked.path.keys =
        value_or_fail(parse_camera_keys(value_or_fail(read_file(options.camera_keys)), options.camera_keys));
  if (options.pictures && asked.frames.count > 1)
    fail_setting("pictures", " is for a film of one frame, and this one has " + std::to_string(asked.frames.count),
                 "name one by " + setting_name("frames") + " 0, or leave " + setting_name("pictures") + " out");

  // Each frame is one picture. One frame alone is shown while the camera moves.
  asked.pictures = options.pictures.value_or(asked.frames.count);
  if (!options.pictures && asked.frames.count == 1) {
    if (!asked.path.keys.empty())
      asked.pictures = asked.path.keys.back().picture + 1;
    else if (asked.path.turntable_deg != 0)
      asked.pictures =
          std::max<std::int64_t>(1, std::llround(kSecondsOfTurn * static_cast<double>(asked.rate.pictures) /
                                                 static_cast<double>(asked.rate.seconds)));
  }
  asked.order = options.order;
  if (asked.pictures > kMostPictures || asked.order.positions(asked.pictures) > kMostPictures)
    fail_usage("a film has at most 100,000,000 pictures");
  if (!asked.path.keys.empty() && asked.path.keys.back().picture >= asked.pictures)
    fail_setting("camera_keys", fmt::format(": the last key is for picture {}, and the last picture is {}",
                                            asked.path.keys.back().picture, asked.pictures - 1));
  asked.turn_axis = options.turn_axis;
  asked.fit_frames = name_of(kFittedFrames, options.fit_frames);
  asked.follow = options.follow;
  asked.align = options.align;
  if (asked.frames.count == 1 && !(asked.follow + asked.align).empty())
    fail_setting(asked.align.empty() ? "follow" : "align", " is for a film of several frames, and this one has 1",
                 "leave it out");
  asked.range_of_colours = name_of(kRangesOfColours, options.range_of_colours);
  asked.codec = options.codec;
  asked.metadata = options.picture.metadata;
  return asked;
}

FilmPlan::Fixed fixed_by_film(const FrameSource& source, const FilmPlan& plan, const FilmOptions& options,
                              const Style& style) {
  RenderOptions first = options.picture;
  auto [shown, input] = first_shown_frame(source, plan, options, style);
  if (!is_generated(first.input.input)) first.input.reading.set_frame(shown);
  warn(input.warnings);
  const RenderSettings settings = prepare_picture(first, choose_engine(first), input, nullptr, &source);
  if (settings.trails.any() && !options.align.empty())
    fail_setting("trail", " shows where spheres were read, and " + setting_name("align") + " moves them",
                 "leave one of them out");

  FilmPlan::Fixed fixed;
  const Tile drawn = drawn_pixels(settings);
  fixed.width_px = drawn.width();
  fixed.height_px = drawn.height();
  fixed.camera = input.scene.camera;
  if (first.floor) fixed.floor = input.scene.plane->plane;
  fixed.density = input.density;
  const bool user_places = first.eye || first.look_at || first.fit || first.zoom_to;
  if (plan.asked.path.moves() && !user_places && (!input.has_camera || first.view_from || first.view_of))
    fixed.camera = camera_around(input, fixed.camera, first, settings);
  if (plan.asked.path.turntable_deg != 0) fixed.turn_axis = axis_of_turntable(input, fixed.camera, options);
  if (!options.follow.empty()) {
    fixed.shifts = shifts_of(source, plan, options.follow, style);
    // The camera is that of the frame that is shown first.
    const Vec3d of_shown = fixed.shifts[static_cast<std::size_t>(*plan.asked.frames.picture_of(shown))];
    for (Vec3d& shift : fixed.shifts) shift = shift - of_shown;
  }
  if (!options.align.empty()) fixed.motions = motions_of(source, plan, options.align, style);
  if (options.fit_frames != FittedFrames::first) check_fit_of_frames(plan, options, input, settings);
  if (options.fit_frames == FittedFrames::all) {
    FilmPlan begun = plan;
    begun.fixed = fixed;
    fixed.camera = camera_over_frames(source, begun, options, style, input, settings);
  }
  if (options.range_of_colours == RangeOfColours::frame) return fixed;
  fixed.range_of_style = range_of_style(input, first.looks);
  fixed.ranges_of_looks = ranges_of_looks(input, first.looks);
  if (options.range_of_colours == RangeOfColours::film) widen_over_film(source, plan, options, style, fixed);
  give_extent(fixed.range_of_style);
  for (ColourRange& range : fixed.ranges_of_looks) give_extent(range);
  return fixed;
}

}  // namespace bihive::cli
