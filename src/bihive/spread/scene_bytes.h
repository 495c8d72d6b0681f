// A scene without its spheres, and how it is drawn, as bytes for other processes.
#pragma once

#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/spread/bytes.h"

namespace bihive {

/// All that Scene and RenderSettings say, but for the columns that have an entry for each sphere (named columns without
/// their entries) and the copies of a replicated set.
void put_scene(const Scene& scene, const RenderSettings& settings, Bytes& bytes);
void take_scene(ByteReader& bytes, Scene& scene, RenderSettings& settings);

}  // namespace bihive
