// One picture of a film: its frame, camera and ranges.

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/job/input.h"
#include "commands/names.h"
#include "film/film_plan.h"

namespace bihive::cli {

void take_film(RenderOptions& options, const FilmPlan& plan) {
  const FilmPlan::Asked& asked = plan.asked;
  const bool has_frame = options.input.reading.has("frame");
  const std::int64_t frame = options.input.reading.options().frame;
  if (!options.picture_of_film && !has_frame)
    fail_setting("film", " needs the number of a frame of the input or of a picture of the film",
                 "give " + setting_name("frame") + " I or " + setting_name("picture") + " K, from 0");
  if (options.picture_of_film && has_frame)
    fail_setting("picture", " and " + setting_name("frame") + " both say which picture it is");
  std::int64_t picture = 0;
  if (options.picture_of_film) {
    const std::int64_t position = *options.picture_of_film;
    if (position >= plan.positions())
      fail_usage(fmt::format("the film has no picture {}: its last one is {}", position, plan.positions() - 1));
    picture = plan.picture_at(position);
  } else {
    const std::optional<std::int64_t> found = asked.frames.picture_of(frame);
    if (!found)
      fail_usage(fmt::format("frame {} is not in the film, which has frames {} to {} by steps of {}", frame,
                             asked.frames.first, asked.frames.frame(asked.frames.count - 1), asked.frames.step));
    if (asked.frames.count == 1 && asked.pictures > 1)
      fail_usage("all pictures of the film show this frame",
                 "say which one by " + setting_name("picture") + " K, from 0");
    picture = *found;
  }
  if (!is_generated(options.input.input)) options.input.reading.set_frame(plan.frame_of(picture));
  CameraPath path = asked.path;
  path.axis = plan.fixed.turn_axis;
  Camera camera = camera_at(path, plan.fixed.camera, picture, asked.pictures);
  const auto position = static_cast<std::size_t>(picture);
  if (!plan.fixed.shifts.empty()) {
    camera.eye = camera.eye + plan.fixed.shifts.at(position);
    camera.look_at = camera.look_at + plan.fixed.shifts.at(position);
  }
  options.metadata = options.metadata && asked.metadata;
  options.fixed = FixedByFilm{camera, plan.fixed.range_of_style, plan.fixed.ranges_of_looks};
  options.fixed->fits_each = asked.fit_frames == name_of(kFittedFrames, FittedFrames::each);
  options.fixed->floor = plan.fixed.floor;
  options.fixed->density = plan.fixed.density;
  if (!plan.fixed.motions.empty()) options.fixed->motion = plan.fixed.motions.at(position);
}

}  // namespace bihive::cli
