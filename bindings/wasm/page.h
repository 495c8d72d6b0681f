// The functions that the page's worker calls: the viewer, with text and bytes instead of C++ types.
//
// Every method that can fail returns a JSON text (answers.h). Everything runs on the thread of the caller, and on the
// threads that the library makes.
#pragma once

#include <emscripten/val.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/io/frames.h"
#include "bihive/viewer/choices.h"
#include "bihive/viewer/pick.h"
#include "bihive/viewer/player.h"
#include "bihive/viewer/viewer.h"

namespace bihive::page {

class Page {
 public:
  // The scene. Answers: {"facts": {...}, "settings": {...}, "look": {...}, "coloured_by": [...]}. `how`: the
  // JSON of io/reading_settings.h.

  /// The folder of the user's files (Emscripten's WORKERFS), with a slash at its end. Answers leave it out.
  static std::string folder();
  /// A file there, and its trajectory, or an empty text. Both must stay until the next scene is loaded: frames are read
  /// on request.
  std::string load(const std::string& name, const std::string& trajectory, const std::string& how);
  /// `count` 0: the scenario's own number of spheres. Only the radii of `how` matter: the rest is for files, and may
  /// come from the page's address.
  std::string load_built_in(const std::string& name, double count, const std::string& how);

  // The player of a file with several frames. Times are of any steady clock, in milliseconds.

  /// {"frames", "frame", "shown", "playing", "loops", "frames_per_second", "time_ps" or null, "title"}
  std::string player() const;
  void toggle_play(double now_ms);
  void step_frames(int by) { player_.step(by); }
  void go_to_frame(double frame);
  void set_frames_per_second(double speed) { player_.set_frames_per_second(speed); }
  void set_loops(bool loops) { player_.set_loops(loops); }
  /// Advances when it is time, and reads and shows the requested frame.
  std::string continue_playing(double now_ms);

  // The settings, as JSON texts (viewer/viewer_json.h). set() leaves settings unchanged that its text does not name.

  std::string settings() const;
  std::string set(const std::string& changes);
  void resize(int width_px, int height_px) { viewer_.resize(width_px, height_px); }
  void orbit(double dx_px, double dy_px) { viewer_.orbit(dx_px, dy_px); }
  void pan(double dx_px, double dy_px) { viewer_.pan(dx_px, dy_px); }
  void zoom(double factor, double x_px, double y_px) { viewer_.zoom(factor, x_px, y_px); }
  std::string look_from(const std::string& side);
  void home() { viewer_.home(); }
  /// The settings with the camera of `camera`, {"camera": {...}}, so far away that a picture of this size shows all.
  std::string far_enough(const std::string& camera, int width_px, int height_px) const;

  // The look (viewer/viewer_json.h).

  /// viewer/choices.h.
  std::string choices() const { return choices_to_json(); }
  std::string look() const;
  /// {"counts": [spheres of each row], "coloured_by": [{"attribute", "range": [min, max]}]}; categories have no range.
  /// An error also has {"row": the faulty row, or -1}.
  std::string set_look(const std::string& changes);

  // The graphics processor: WebGL2's current context.

  std::string attach_gl();  ///< {"description": ...}
  void detach_gl(bool lost) { viewer_.detach_gl(lost); }

  // Pictures.

  /// {"drawn", "settled", "done", "divisor", "frame_ms", "fps", "mray_per_s"}.
  std::string frame(double budget_ms);
  /// The CPU engine's last picture: {"width", "height"}, and its pixels as a view of memory, four bytes each.
  std::string take_image();
  emscripten::val pixels() const;
  /// The GPU engine's, into the whole canvas.
  void show(int width_px, int height_px);
  /// Before the first frame: a transparent background is left transparent, instead of grey checks.
  void let_page_through() { viewer_.show_checks(false); }
  /// The sphere under (x, y): {"picked": as viewer/pick.h, or null}.
  std::string pick(double x_px, double y_px) const;
  /// The same of a sphere by its id, at its centre. Ids here are those of the input: hidden spheres count too.
  std::string sphere(double id) const;
  /// {"value": of geometry/measures.h, or null, "nearest_images": a periodic cell has made it another one}: the
  /// distance, angle or dihedral angle of an array of two to four ids.
  std::string measured(const emscripten::val& ids) const;
  /// {"line"}: the measure in a frame as a line of the table that `bihive info --distance` and its relatives print.
  std::string measured_in(double frame, const emscripten::val& ids) const;
  /// viewer/shown_measures.h.
  std::string measures(const std::string& selection, double probe) const;
  // Groups, legend and histogram of the scene (viewer/contents.h).
  std::string contents() const;
  std::string legend() const;
  std::string histogram(const std::string& attribute, int bins) const;
  /// The way of the ray through (x, y): Viewer::ray_paths_json().
  std::string ray_paths(double x_px, double y_px) const;
  std::string statistics() const { return viewer_.statistics_json(); }

  // A picture to be saved, one step for each call. frame() and set() drop it.

  std::string begin_picture(int width_px, int height_px, int samples_per_pixel);
  std::string step_picture(double budget_ms);  ///< {"done": 0 to 1}
  /// The finished picture: {"width", "height", "channels"}, and its pixels as a view of memory. Three channels, or four
  /// with opacity, where the colour is not multiplied by it.
  std::string take_picture();
  void drop_picture() { viewer_.drop_picture(); }

 private:
  void start_player(std::int64_t frame);
  std::optional<std::int64_t> stored_id(double id) const;
  std::string picked_json(const Picked& picked) const;
  Status show_frame(std::int64_t frame);
  std::string loaded(const Result<SceneFacts>& facts) const;

  Viewer viewer_;
  std::shared_ptr<const Frames> frames_;  // null: there is one
  Player player_;
  std::int64_t frame_in_viewer_ = 0;
  bool frame_is_drawn_ = true;  // that one
  std::vector<std::uint8_t> pixels_;
};

}  // namespace bihive::page
