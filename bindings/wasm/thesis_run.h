// Figure 4.4 of the thesis on this device, one step for each call. A module of the page has these classes alone, and so
// has the one of the page for phones (web/phone.html). Answers are JSON texts (answers.h).
#pragma once

#include <emscripten/val.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/gl/gl_renderer.h"
#include "bihive/thesis/frame_rates.h"
#include "bihive/thesis/shown_frames.h"

namespace bihive::page {

/// A run by one engine: the reference engine, or with `gpu` the shader in WebGL2's current context.
class ThesisRun {
 public:
  explicit ThesisRun(bool gpu) : gpu_(gpu) {}

  /// All rounds of a configuration, then those of the next. Pictures are smaller if the run would take more than ten
  /// minutes, a quick run more than one. `saved`: the result of an earlier run that was not completed, or any other
  /// text; its measurements are kept if it is one of the same plan and engine. Answers {"width_px", "height_px",
  /// "resumed": configurations that are done}.
  std::string begin(bool quick, const std::string& saved);
  /// Instead: one round of all configurations, in pictures with which a pass takes at most `seconds`, about. Further
  /// passes draw pictures of the same size; their rounds follow those of the passes before. Answers {"width_px",
  /// "height_px"}.
  std::string begin_pass(double seconds);

  /// {"finished", "done", "seconds_left", "configurations_done", "configurations", "scenario", "spheres", "round_ms"
  /// (once it is finished: the last round of all configurations)}.
  std::string step();
  /// The results of complete passes: {"result": JSON text, "charts": [SVG text]}; of a complete run also the fitted
  /// costs of a ray's steps, which takes a second or two. `device`: a JSON object with "device", a description, and
  /// other texts by name.
  std::string so_far(const std::string& device) const;

 private:
  const char* name() const { return gpu_ ? "gpu" : "cpu"; }
  Result<GlRenderer*> renderer();

  const bool gpu_;
  std::optional<GlRenderer> renderer_;
  std::shared_ptr<FrameRateRun> run_, earlier_;  // earlier_: all complete passes
};

/// Frames shown per second (thesis/shown_frames.h). The caller draws a picture, shows it, and says when it is shown.
class ShownFramesRun {
 public:
  std::string begin(double seconds);
  /// {"width", "height"}, and the pixels as a view of memory by pixels().
  std::string draw();
  emscripten::val pixels() const;
  /// {"finished", "done": 0 to 1, "scenario", "spheres", "max_prims" (null: the wide engine), "turning"}
  std::string shown(double now_ms);
  /// {"result": JSON text}
  std::string result(const std::string& device) const;

 private:
  std::optional<ShownFrames> frames_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace bihive::page
