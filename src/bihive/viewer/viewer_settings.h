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
#include "bihive/settings/overrides.h"

namespace bihive {

enum class ViewerEngine { cpu, gpu };

inline const Names<ViewerEngine> kViewerEngines{{"cpu", ViewerEngine::cpu}, {"gpu", ViewerEngine::gpu}};

/// Maximum samples of a picture at rest; `bihive render` draws more.
constexpr int kMostSamples = 64;

/// All choices of the user. Plain data; viewer/viewer_json.h turns them into JSON, for links and saved states.
struct ViewerSettings {
  ViewerEngine engine = ViewerEngine::cpu;
  View view = View::shaded;
  /// The user's settings, over the scene's own picture with at most kMostSamples samples per pixel. The edges of the
  /// cell are drawn by the CPU alone, and stay in view.
  LayeredSettings picture;
  std::optional<std::int64_t> max_prims, max_depth;  ///< >= 1; unset: the engine chooses
  /// Copies along the vectors of the cell, each 1 to 1000000; unset: those of the input. Without a cell, or with the
  /// GPU engine, no more than 1 x 1 x 1.
  std::optional<std::array<std::int32_t, 3>> replicate;
  Camera camera;
  /// With an aperture: the selection (docs/selections.md) whose centre is sharp, wherever the camera goes. Empty:
  /// camera.focus.
  std::string focus_on;
};

/// Error: out of range, a camera that sees nothing (check_camera), adaptive samples with an aperture, or fog that ends
/// before it begins.
Status check_settings(const ViewerSettings& settings);
bool same_tree(const ViewerSettings& a, const ViewerSettings& b);
TreeParameters tree_parameters(const ViewerSettings& settings);
/// Whether engine or view use the reference tree, not the wide one.
bool needs_reference_tree(const ViewerSettings& settings);
/// Whether the engine draws adaptive samples, and the settings request them: samples_per_pixel does not count.
bool draws_adaptive_samples(const ViewerSettings& settings);
/// Samples per pixel at rest; with adaptive samples those of every pixel.
int samples_at_rest(const ViewerSettings& settings);
/// For a picture of that size; the GPU engine draws no adaptive samples. `samples_per_pixel` does not count with
/// adaptive samples.
RenderSettings render_settings(const ViewerSettings& settings, int width_px, int height_px, int samples_per_pixel);

}  // namespace bihive
