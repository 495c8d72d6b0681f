// The scene file: JSON, checked against the published schema (docs/scene.schema.json), then against what a schema
// cannot say.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// A scene with what the user should be told of where it comes from.
struct LoadedScene {
  Scene scene;
  bool has_camera = false;  ///< false: the caller frames the spheres
  bool has_lights = false;
  std::string format = "scene file";  ///< or "built-in", or a sphere file's format (scene/load_scene.h)
  std::int64_t frames = 1;            ///< frames or models in the sphere file that the document names
  std::vector<std::string> rules;     ///< what was done to its spheres, a sentence each
  Vec3d recentred_by;                 ///< subtracted from every centre; 0 without `recenter`
  std::vector<std::string> warnings;
};

/// `name` is the file's name for messages and the place that the document's own relative paths start from. The options
/// apply to inline spheres as to a sphere file that the document names, and go before what the document says; where the
/// options alone recentre, camera, lights and plane move along. Errors name the path inside the document
/// (/materials/0/power) and what was expected there.
Result<LoadedScene> parse_scene(std::string_view json, const std::string& name, const ReadOptions& options);

/// True where the bytes look like a scene document (first character after white space is '{').
bool looks_like_scene(std::string_view bytes);

/// A complete document with the spheres inline; parse_scene() gives back an equal scene.
std::string scene_to_json(const Scene& scene);

/// The JSON Schema itself, as text.
std::string_view scene_schema();

}  // namespace bihive
