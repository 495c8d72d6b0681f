// The choices of the viewer's user.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/names.h"
#include "bihive/scene/render_settings.h"
#include "bihive/viewer/viewer_effects.h"

namespace bihive {

enum class ViewerEngine { cpu, gpu };

inline const Names<ViewerEngine> kViewerEngines{{"cpu", ViewerEngine::cpu}, {"gpu", ViewerEngine::gpu}};

constexpr int kMostRecursion = 16;
constexpr int kMostSamples = 64;

/// All choices of the user. Plain data; viewer/viewer_json.h turns them into JSON, for links and saved states.
struct ViewerSettings {
  ViewerEngine engine = ViewerEngine::cpu;
  View view = View::shaded;
  int recursion = 5;          ///< 1 to kMostRecursion
  int samples_per_pixel = 4;  ///< 1 to kMostSamples, once at rest
  bool shadows = true;
  std::optional<std::int64_t> max_prims, max_depth;  ///< >= 1; unset: the engine chooses
  ViewerEffects effects;
  bool cell = false;  ///< draw the edges of the periodic cell, if there is one, and keep them in view; on the CPU
  /// Copies along the vectors of the cell, each 1 to 1000000; unset: those of the input. Without a cell, or with the
  /// GPU engine, no more than 1 x 1 x 1.
  std::optional<std::array<std::int32_t, 3>> replicate;
  Camera camera;
  /// With an aperture: the selection (docs/selections.md) whose middle is sharp, wherever the camera goes. Empty: what
  /// camera.focus says.
  std::string focus_on;
};

/// Error: out of range, a camera that sees nothing (check_camera), or adaptive samples with an aperture.
Status check_settings(const ViewerSettings& settings);
bool same_tree(const ViewerSettings& a, const ViewerSettings& b);
TreeParameters tree_parameters(const ViewerSettings& settings);
/// The engine or the view walks the reference tree, not the wide one.
bool needs_reference_tree(const ViewerSettings& settings);
/// The engine draws adaptive samples, and the settings ask for them: samples_per_pixel does not count.
bool draws_adaptive_samples(const ViewerSettings& settings);
/// The samples of a picture at rest: their number, or with adaptive samples that of every pixel.
int samples_at_rest(const ViewerSettings& settings);
/// For a picture of that size with the effects of the settings; the GPU engine draws no adaptive samples.
/// `samples_per_pixel` does not count where adaptive samples are on.
RenderSettings render_settings(const ViewerSettings& settings, const PictureDefaults& defaults, int width_px,
                               int height_px, int samples_per_pixel);

}  // namespace bihive
