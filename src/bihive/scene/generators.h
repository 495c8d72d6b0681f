// The thesis's scenes: three scenarios of n spheres in the cube [-20, 20]^3, and the four spheres of Figure 4.2.
#pragma once

#include <cstdint>

#include "bihive/base/result.h"
#include "bihive/scene/scene.h"

namespace bihive {

enum class Scenario { grid = 1, corners = 2, mixed = 3 };

struct ScenarioParameters {
  std::int64_t count = 4096;  ///< >= 1
  float radius = 1;           ///< > 0; below 20 for the grid, below half of corner_side in corners
  std::uint64_t seed = 1;
  /// Of the small cubes in the corners; > 0, at most 20. The thesis does not state it; 8 gives the statistics of its
  /// Table 4.2.
  float corner_side = 8;
};

/// The radius of ScenarioParameters for a number from a user. A number beyond binary32 becomes infinite, which no
/// scenario takes.
float scenario_radius(double radius);

/// The spheres alone. Scenario 1: a regular grid. 2: eight random clusters, one a corner. 3: half and half, clusters
/// first. All arithmetic is binary32 in the order that the reference gives, because ties of one ulp decide the tree.
Result<SphereSet> scenario_spheres(Scenario scenario, const ScenarioParameters& parameters);

/// The spheres with the thesis's camera, light, plane, materials (red and transparent in turn), black background, no
/// shadows, no transfer curve, one sample a pixel.
Result<Scene> scenario_scene(Scenario scenario, const ScenarioParameters& parameters);

/// Figure 4.2: three red spheres and a transparent one. Each of the recursion depths 1 to 5 is the deepest depth of
/// some pixel. Everything else as in scenario_scene().
Scene four_spheres_scene();

/// The thesis's plane: y = -20, matte checker of 5 x 5 units.
ScenePlane thesis_plane();

/// Camera, light, plane, materials, background and picture defaults of the thesis, without spheres.
Scene thesis_scene_without_spheres();

}  // namespace bihive
