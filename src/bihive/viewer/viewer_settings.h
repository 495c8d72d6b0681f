// The choices of the viewer's user.
#pragma once

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
  Camera camera;
};

/// Error: out of range, or a camera that sees nothing (check_camera).
Status check_settings(const ViewerSettings& settings);
bool same_tree(const ViewerSettings& a, const ViewerSettings& b);
TreeParameters tree_parameters(const ViewerSettings& settings);
/// The engine or the view walks the reference tree, not the wide one.
bool needs_reference_tree(const ViewerSettings& settings);
/// For a picture of that size with the effects of `defaults`; the GPU engine draws none of them.
RenderSettings render_settings(const ViewerSettings& settings, const PictureDefaults& defaults, int width_px,
                               int height_px, int samples_per_pixel);

}  // namespace bihive
