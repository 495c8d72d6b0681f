// The synthetic scenes of the benchmark.
#pragma once

#include <optional>
#include <string>

#include "bihive/scene/scene.h"

namespace bihive::bench {

/// Half the side of the cube around the origin that holds the spheres.
constexpr float kCubeHalf = 20;

/// s1 s2 s3, c1e6, or uN with N from 1e3 to 1e8 (bench_scene.h); nothing for any other name. All spheres are the
/// thesis's red (reflection 0.3) over its plane, under its light, seen by its camera.
std::optional<Scene> synthetic_scene(const std::string& name);

}  // namespace bihive::bench
