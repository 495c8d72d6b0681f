// The shown scene, with its description for the user and the trees that its pictures need.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/scene/camera.h"
#include "bihive/scene/camera_lights.h"
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
  bool takes_style = false;                  ///< false: the scene has its own appearance
  bool is_file_of_spheres = false;           ///< a style determines its appearance
  bool has_elements = false;
  std::string title{}, entry_id{};                ///< as in io/read_spheres.h
  std::optional<double> time_ps{};                ///< of the frame, picoseconds, where the file states it
  bool has_cell = false;                          ///< a periodic cell
  std::array<std::int32_t, 3> copies{{1, 1, 1}};  ///< along the cell's vectors, as the input asks for
  std::vector<std::string> attributes{};          ///< names for selections and colours
};
SceneFacts facts_of(const LoadedScene& loaded);
/// What the scene is, for people: "TITLE · ENTRY", where its file says both, else the file's name without its folder.
std::string title_of(const SceneFacts& facts);

/// Never moved in memory: its trees refer to its spheres.
struct ShownScene {
  Scene scene;  ///< at least one sphere
  bool has_camera = false, has_lights = false, states_fog = false;
  LightRig rig;         ///< the lights of a scene without its own
  Camera own_camera;    ///< if it has one
  double diagonal = 0;  ///< of the spheres' box
  std::unique_ptr<SceneTrees> trees;

  explicit ShownScene(LoadedScene loaded);
  ShownScene(const ShownScene&) = delete;
  ShownScene& operator=(const ShownScene&) = delete;

  /// frame_picture() of these settings, with room for their labels. Angle, projection and lens are those of `like`.
  Camera framed(ViewFrom side, const Camera& like, const ViewerSettings& settings, PictureSizePx size) const;
  /// with_all_in_view() of the spheres that clips leave, and of the cell's edges.
  Camera far_enough(const Camera& camera, bool cell, PictureSizePx size) const;
  /// Whether the other scene has the same spheres and clips, whatever the spheres' other attributes: then these trees
  /// are right for both.
  bool same_spheres(const ShownScene& other) const;
  bool same_clips(const ShownScene& other) const;
  /// Replaces the scene by another with the same spheres, and keeps the trees.
  void take_look_of(ShownScene&& other);
  /// Uses the camera of these settings from now on. The lights of a scene without its own turn with the camera.
  void look_by(const ViewerSettings& settings);
};

}  // namespace bihive
