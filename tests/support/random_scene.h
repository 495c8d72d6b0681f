// Scenes and settings of every kind, by a seed.
#pragma once

#include <cstdint>

#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive::test {

/// Random spheres of many materials, lights and a plane: reflecting, transparent, both or neither; inside each other;
/// with opacities and colours of their own.
Scene random_scene(std::uint64_t seed);

/// A small picture.
RenderSettings random_settings(std::uint64_t seed);

}  // namespace bihive::test
