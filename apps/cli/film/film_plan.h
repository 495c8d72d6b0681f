// The description of a film, in the file beside it: everything that its pictures depend on besides their frames.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/job/picture_record.h"
#include "bihive/job/rigid_motion.h"
#include "bihive/scene/camera_path.h"
#include "bihive/scene/frame_range.h"
#include "commands/commands.h"

namespace bihive::cli {

struct FilmPlan {
  /// The user's request and the input's file. A run resumes another one if they are equal.
  struct Asked {
    std::string program;           ///< its version
    nlohmann::ordered_json input;  ///< path, size and time of its files
    FrameList frames;              ///< of the input
    std::int64_t pictures = 1;     ///< that are drawn: one per frame; or all of one frame
    PictureOrder order;
    FrameRate rate;
    std::vector<std::string> options;  ///< of each picture
    CameraPath path;
    std::string turn_axis;      ///< x, y, z, picture; empty: the world's up
    std::string follow, align;  ///< selections; empty: none
    std::string fit_frames = "first";
    std::string range_of_colours;
    std::string codec;
    bool metadata = true;  ///< its files say how they were made
  } asked;

  /// Records the request for all pictures; unset without metadata.
  std::optional<PictureRecord> record;

  /// Values from the film's first frame.
  struct Fixed {
    int width_px = 0, height_px = 0;   ///< of a picture in the film
    Camera camera;                     ///< before it moves
    std::optional<Vec3d> turn_axis;    ///< unset: the picture's vertical
    std::vector<Vec3d> shifts;         ///< of the camera, in each frame of the film; empty: none
    std::vector<RigidMotion> motions;  ///< of the spheres, likewise
    std::optional<Plane> floor;        ///< of the option `floor`
    std::optional<Density> density;    ///< of the style
    ColourRange range_of_style;
    std::vector<ColourRange> ranges_of_looks;
  } fixed;

  /// The finished film, if it is one file.
  struct Made {
    std::int64_t bytes = 0;
    std::uint64_t hash = 0;
  };
  std::optional<Made> made;

  std::int64_t frame_of(std::int64_t picture) const {
    return asked.frames.count == 1 ? asked.frames.first : asked.frames.frame(picture);
  }
  /// The film has this many pictures, which count the repeated ones.
  std::int64_t positions() const { return asked.order.positions(asked.pictures); }
  std::int64_t picture_at(std::int64_t position) const { return asked.order.picture_at(position, asked.pictures); }
  /// The first position that shows the same picture.
  std::int64_t first_position(std::int64_t position) const {
    return asked.order.first_position(position, asked.pictures);
  }
};

std::string film_plan_to_json(const FilmPlan& plan);

/// The part of the description that a record holds as PictureRecord::film: without the input, the options, and what
/// differs between machines. And that part again. Fails with kBadInput if it is not one; `path` is for the message.
std::string film_of_record(const FilmPlan& plan);
FilmPlan plan_of_record(const PictureRecord& record, const std::string& path);

/// No film has more pictures.
constexpr std::int64_t kMostPictures = 100'000'000;

/// Fails with kBadInput if the file is not such a description, or has numbers out of range.
FilmPlan read_film_plan(const std::string& path);
/// The same of its bytes; `path` and `hint`, if it is not empty, are for messages.
FilmPlan parse_film_plan(const std::string& text, const std::string& path, const std::string& hint = "");

/// The difference of two requests, for a message: "its frames are ..., not ..."; empty: nothing.
std::string difference(const FilmPlan::Asked& kept, const FilmPlan::Asked& asked);

/// Sets the options' frame, camera and ranges to those of the picture that `options.picture_of_film` or
/// the setting `frame` of the input names. Fails with kBadUsage if the film has no such picture.
void take_film(RenderOptions& options, const FilmPlan& plan);

}  // namespace bihive::cli
