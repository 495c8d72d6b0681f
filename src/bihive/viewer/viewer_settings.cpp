#include "bihive/viewer/viewer_settings.h"

namespace bihive {

Status check_settings(const ViewerSettings& settings) {
  const auto bad = [](const std::string& message) { return Error{message, "", 0, 0, ""}; };
  const auto outside = [](std::int64_t value, std::int64_t min, std::int64_t max) {
    return value < min || value > max;
  };
  if (outside(settings.recursion, 1, kMostRecursion))
    return bad("recursion must be from 1 to " + std::to_string(kMostRecursion));
  if (outside(settings.samples_per_pixel, 1, kMostSamples))
    return bad("samples a pixel must be from 1 to " + std::to_string(kMostSamples));
  if (settings.max_prims.value_or(1) < 1 || settings.max_depth.value_or(1) < 1)
    return bad("max_prims and max_depth must be at least 1");
  return check_camera(settings.camera);
}

bool same_tree(const ViewerSettings& a, const ViewerSettings& b) {
  return a.max_prims == b.max_prims && a.max_depth == b.max_depth;
}

TreeParameters tree_parameters(const ViewerSettings& settings) {
  return {settings.max_prims, settings.max_depth};
}

bool needs_reference_tree(const ViewerSettings& settings) {
  return settings.engine == ViewerEngine::gpu || settings.view == View::traversal || settings.view == View::tree;
}

RenderSettings render_settings(const ViewerSettings& settings, const PictureDefaults& defaults, int width_px,
                               int height_px, int samples_per_pixel) {
  const bool gpu = settings.engine == ViewerEngine::gpu;
  const bool of_tree = settings.view == View::traversal || settings.view == View::tree;
  RenderSettings picture = gpu ? RenderSettings{} : settings_from(defaults);
  if (of_tree) picture.transparent = false;
  picture.adaptive_samples = false;  // people choose their number
  picture.width_px = width_px;
  picture.height_px = height_px;
  picture.samples_per_pixel = samples_per_pixel;
  picture.recursion = settings.recursion;
  picture.shadows = settings.shadows;
  picture.view = settings.view;
  return picture;
}

}  // namespace bihive
