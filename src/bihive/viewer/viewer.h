// The model shared by the native window and the page: moving around a scene, and switching views, engines and
// parameters of the tree. It knows neither window nor page.
//
// Pictures are drawn in steps: while something moves, at a resolution that keeps to the budget of a frame; at rest,
// ever finer up to every pixel and all samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/image/image.h"
#include "bihive/image/png_pixels.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/scene.h"
#include "bihive/viewer/frame_maker.h"
#include "bihive/viewer/frame_report.h"
#include "bihive/viewer/pick.h"
#include "bihive/viewer/shown_scene.h"
#include "bihive/viewer/viewer_look.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

class Viewer {
 public:
  Viewer();
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // The scene. After an Error the previous scene stays, with everything else. A new scene resets camera and picture
  // defaults (samples, recursion, shadows, edges of the cell, effects); engine, view and parameters of the tree stay.
  // The style stays from one file of spheres to the next; the rest of the look is reset. The lights of a scene without
  // its own turn with the camera, as in `bihive render`.

  /// "demo", "scenario1", "scenario2", "scenario3", "four-spheres". The parameters are the scenarios', the options the
  /// demo's.
  Result<SceneFacts> load_built_in(const std::string& name, const ScenarioParameters& parameters = {},
                                   const ReadOptions& options = {});
  /// The bytes of a file of spheres or of a scene file, compressed or not.
  Result<SceneFacts> load(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
  /// Spheres already read; `name` is their file's.
  Result<SceneFacts> load(SphereFile spheres, const std::string& name);
  /// A scene made by the caller, at least one sphere; without `has_camera` the whole set comes into view.
  Result<SceneFacts> load(Scene scene, SceneFacts facts, bool has_camera, bool has_lights);
  const SceneFacts& facts() const;  ///< empty before the first scene
  const Scene& scene() const;       ///< without spheres before the first
  /// The spheres of the shown frame as they were read: those that the look hides too.
  const SphereSet& input_spheres() const;

  // The look. The picture is the one that `bihive render` draws with the same choices.

  const ViewerLook& look() const;
  /// Another style sets its own samples, recursion, shadows and effects, except those that the user has changed. A
  /// camera that shows the whole set is placed again, unless clips are what changes after a frame was drawn: they leave
  /// it, so that what remains stays in its place. Returns how many spheres each row selects. Errors: an unknown
  /// style, colour or action, a style for a scene that has a look of its own, a selection's (with its column), an
  /// attribute that the scene lacks, or that every sphere is hidden; the previous look stays. `failed_row` (if given)
  /// is then the faulty row; rows.size() if none is.
  Result<std::vector<std::int64_t>> set_look(const ViewerLook& look, std::size_t* failed_row = nullptr);

  // The frames of the shown file. viewer/player.h decides which one is shown when.

  /// Makes frames with the current appearance. Null if the scene is not a file of spheres. The same one until the look,
  /// the copies or the parameters of the tree change: so colours keep their ranges from frame to frame.
  std::shared_ptr<const FrameMaker> frame_maker() const;
  /// Shows a frame, once; camera, settings and look stay, and the facts are the frame's. False: the look, the copies or
  /// the parameters of the tree have changed since its maker was made, and the frame must be made again. Error: as
  /// set(); the previous frame stays.
  Result<bool> show_frame(PreparedFrame& frame);

  // The GPU. Its context must be current in every call while one is attached.

  Status attach_gl(const GlFunctions& functions);
  /// The context is gone, or about to go (`lost` false: objects are deleted). ViewerEngine::gpu is then an Error; if it
  /// was chosen, the CPU takes over.
  void detach_gl(bool lost);
  bool has_gl() const;
  std::string gl_description() const;  ///< empty without one

  // The settings. Each of these calls restarts the picture.

  const ViewerSettings& settings() const;
  /// Error: out of range, a camera that sees nothing (check_camera), no graphics processor, a view that the engine does
  /// not have, or a new request that the picture cannot fulfil: a scale bar in perspective, a legend of colours without
  /// a meaning, a focus on spheres that do not exist. The previous settings stay. Parameters that changed rebuild the
  /// tree. A camera that shows the whole set still does so after a change of projection, angle or lens alone.
  Status set(const ViewerSettings& settings);
  /// Size of the picture at rest. 1 to 16384 each. A camera that shows the whole set is placed again.
  void resize(int width_px, int height_px);
  /// The pointer moved by this many pixels: turn around look_at (the scene follows the pointer), or shift the scene. A
  /// camera that shows the whole set still does so while the set turns.
  void orbit(double dx_px, double dy_px);
  void pan(double dx_px, double dy_px);
  /// The same camera, as much farther away as a picture of this size needs to show the whole set; of parallel rays,
  /// with a longer shorter side. It never comes nearer. Costs a pass over the spheres.
  Camera far_enough(const Camera& camera, int width_px, int height_px) const;
  /// A factor above 1 comes closer. The point under (x, y) in pixels stays fixed. Does nothing if the factor is not
  /// finite or not above 0.
  void zoom(double factor, double x_px, double y_px);
  void look_from(ViewFrom side);  ///< the whole set in view, with the projection of the settings
  void home();                    ///< the scene's own camera, or all in view from the front; the projection likewise

  // Pictures.

  /// Continues the picture for about `budget_ms`. After a change the first picture is drawn at once, coarse enough for
  /// the budget. If it overruns the budget, a report without a picture is returned after at most four times the budget,
  /// and the next call continues it. Before the first scene it is settled. Error: not enough memory, or an error of the
  /// graphics processor.
  Result<FrameReport> frame(double budget_ms);
  /// The last picture of the CPU engine, `divisor` times smaller than the requested size, or with labels of that size;
  /// display values.
  const Image& image() const;
  /// The opacity of its pixels, one byte each; empty: all are opaque.
  const std::vector<std::uint8_t>& opacity() const;
  /// A transparent background is shown as grey checks. False: it is left transparent. image() then has opacity(), and
  /// show() writes it, with colours multiplied by it. Call it before the first frame.
  void show_checks(bool checks);
  /// The last picture of the GPU engine, stretched to the viewport. Draws nothing if there is none. The framebuffer
  /// must have one sample per pixel (no antialiasing).
  void show(std::uint32_t framebuffer, const GlViewport& viewport);

  // A picture to be saved, of any size, by the engine of the settings. It is drawn in steps. The pointer may move
  // between two steps, but frame() drops the picture, and so do successful calls of set(), set_look() and load(), and
  // the loss of its GPU.

  Status begin_picture(int width_px, int height_px, int samples_per_pixel);
  /// Draws for about `budget_ms`; returns the finished share, 1 at the end. Error: no picture is in the making (any
  /// more), or an error of the graphics processor.
  Result<double> advance_picture(double budget_ms);
  /// The finished picture, of 8 bits, with opacity if the look's background is "none". Error: it is not finished, or an
  /// error of the graphics processor.
  Result<PngPixels> take_picture();
  void drop_picture();
  /// The whole picture at once.
  Result<PngPixels> picture(int width_px, int height_px, int samples_per_pixel);

  /// The sphere under (x, y) in pixels of the picture at rest, found by one exact ray of the camera; nothing if none is
  /// there, or in the view of the tree. Error: as set().
  Result<std::optional<Picked>> pick(double x_px, double y_px) const;

  /// The way of the ray through (x, y) of the picture at rest through both trees, as `bihive compare --pixel --json`
  /// prints it, with the ids of the input. The trees are those of whole spheres. Errors: a scene with copies, clips or
  /// cavities, whose rays take other ways; no scene; memory too small for a tree.
  Result<std::string> ray_paths_json(double x_px, double y_px) const;

  /// Both trees' statistics for the current parameters as in `bihive stats --json`, with the bytes and the build time.
  /// Builds the trees that are not built yet. {"error": "..."} without a scene, or if memory is too small for a tree.
  std::string statistics_json() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bihive
