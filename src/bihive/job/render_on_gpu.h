// Pictures by the GPU, without a window.
#pragma once

#include <cstdint>
#include <string>

#include "bihive/bih/tree.h"
#include "bihive/image/film.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/scene.h"

namespace bihive {

struct GpuPicture {
  Film film;
  std::int64_t primary = 0, others = 0;  ///< rays traced
  double render_ms = 0;                  ///< of the picture, excluding context and upload
  std::string gpu;                       ///< vendor, processor, version
};

/// Without a tree every sphere is tested. `progress` is called several times a second. Fails with kEnvironment if there
/// is no EGL, or if the driver refuses something.
GpuPicture render_on_gpu(const Scene& scene, const Tree* tree, const RenderSettings& settings,
                         const ProgressCallback& progress);

}  // namespace bihive
