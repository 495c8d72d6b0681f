// A scene on show, with its description for the user and the trees that its pictures need.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/scene.h"
#include "bihive/viewer/orbit.h"
#include "bihive/viewer/scene_trees.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

/// The description of a scene, for titles and messages.
struct SceneFacts {
  std::string name, format;
  std::int64_t spheres = 0, frames = 1;
  std::vector<std::string> rules, warnings;  ///< as io/read_spheres.h
};
SceneFacts facts_of(const LoadedScene& loaded);

/// Never moved in memory: its trees refer to its spheres.
struct ShownScene {
  Scene scene;  ///< at least one sphere
  SceneFacts facts;
  bool has_camera = false, has_lights = false;
  Camera own_camera;    ///< if it has one
  double diagonal = 0;  ///< of the spheres' box
  std::unique_ptr<SceneTrees> trees;

  ShownScene(Scene shown, SceneFacts said, bool with_camera, bool with_lights);
  ShownScene(const ShownScene&) = delete;
  ShownScene& operator=(const ShownScene&) = delete;

  /// The camera that has the whole set in view: the spheres, or in View::tree the drawing of their tree.
  Camera framed(ViewFrom side, View view, PictureSizePx size) const;
  /// Uses this camera from now on. A scene without lights of its own is lit from behind the camera.
  void look_by(const Camera& camera);
};

}  // namespace bihive
