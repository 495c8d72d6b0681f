#include "bihive/viewer/viewer_settings.h"

#include <algorithm>

#include "bihive/io/cell_options.h"
#include "bihive/settings/check_picture.h"

namespace bihive {

Status check_settings(const ViewerSettings& settings) {
  const auto bad = [](const std::string& message) { return Error{message, "", 0, 0, ""}; };
  const auto outside = [](std::int64_t value, std::int64_t min, std::int64_t max) {
    return value < min || value > max;
  };
  const PictureSettings picture = settings.picture.result();
  if (outside(picture.samples_per_pixel, 1, kMostSamples))
    return bad("samples per pixel must be from 1 to " + std::to_string(kMostSamples));
  if (settings.max_prims.value_or(1) < 1 || settings.max_depth.value_or(1) < 1)
    return bad("max_prims and max_depth must be at least 1");
  if (Status status = check_picture(picture, settings.camera.aperture); !status) return status;
  if (settings.replicate)
    for (const std::int32_t count : *settings.replicate)
      if (outside(count, 1, kMostCopies))
        return bad("copies along a vector of the cell must be from 1 to " + std::to_string(kMostCopies));
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

bool draws_adaptive_samples(const ViewerSettings& settings) {
  return settings.picture.result().adaptive_samples && settings.engine == ViewerEngine::cpu;
}

int samples_at_rest(const ViewerSettings& settings) {
  return draws_adaptive_samples(settings) ? kFewSamples : settings.picture.result().samples_per_pixel;
}

RenderSettings render_settings(const ViewerSettings& settings, int width_px, int height_px, int samples_per_pixel) {
  const bool gpu = settings.engine == ViewerEngine::gpu;
  const bool of_tree = settings.view == View::traversal || settings.view == View::tree;
  RenderSettings picture = settings_from(settings.picture.result());
  picture.stereo = {};
  picture.adaptive_samples = draws_adaptive_samples(settings);
  if (of_tree) picture.transparent = false;
  picture.width_px = width_px;
  picture.height_px = height_px;
  picture.samples_per_pixel = samples_per_pixel;
  picture.view = settings.view;
  if (gpu) picture.cell_lines.reset();
  return picture;
}

}  // namespace bihive
