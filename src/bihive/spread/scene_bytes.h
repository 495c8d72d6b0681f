// Serializes a scene without its spheres, and its settings, for other processes.
#pragma once

#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/spread/bytes.h"

namespace bihive {

/// All of Scene and RenderSettings except the columns with an entry per sphere (named columns without their entries)
/// and the copies of a replicated set.
void put_scene(const Scene& scene, const RenderSettings& settings, Bytes& bytes);
void take_scene(ByteReader& bytes, Scene& scene, RenderSettings& settings);

}  // namespace bihive
