// Draws a prepared picture into its file.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "bihive/base/cancel.h"
#include "bihive/render/renderer.h"
#include "commands/commands.h"
#include "commands/picture_file.h"

namespace bihive::cli {

/// The report of a picture.
struct Drawn {
  std::int64_t all_rays = 0;
  double render_ms = 0;
  nlohmann::ordered_json rays, gpu;
  nlohmann::ordered_json exchange;  ///< null: all spheres were local
};

Drawn drawn_with(const RenderCounts& rays);

/// Thrown when a signal came while the caller had a CancellableSection.
struct Interrupted {};

/// Writes all bands of the picture into the file, without finish(). Fails with kBadInput after an error, also one of
/// the file. Throws Interrupted after a signal.
Drawn draw_picture(const Scene& scene, const Tracer& tracer, RenderEngine engine, const RenderSettings& settings,
                   const std::vector<Layer>& layers, PictureFile& file, const ProgressCallback& progress);

}  // namespace bihive::cli
