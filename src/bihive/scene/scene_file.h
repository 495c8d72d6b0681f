// The scene file: JSON, checked against the published schema (docs/scene.schema.json), then against rules that a schema
// cannot express.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/looks.h"
#include "bihive/scene/scene.h"
#include "bihive/scene/style.h"

namespace bihive {

/// A scene, and the facts of its origin for the user.
struct LoadedScene {
  Scene scene;
  bool has_camera = false;          ///< false: the caller places the camera
  bool has_lights = false;          ///< false: the caller places the lights of `rig`
  bool states_fog = false;          ///< the document itself has fog, or none; else fog is a style's
  bool has_scheme_colours = false;  ///< a style's scheme coloured the spheres, not their file
  bool has_assumed_radii = false;   ///< as SphereFile::assumed_radii
  LightRig rig;
  std::string format = "scene file";    ///< or "built-in", or a sphere file's format (scene/load_scene.h)
  std::string title, entry_id;          ///< of its sphere file: as in SphereFile
  std::int64_t frames = 1;              ///< frames or models in the document's sphere file
  std::int64_t stated_frame = 0;        ///< that the document names, as ReadOptions::frame, which goes first unless 0
  std::optional<double> time_ps;        ///< of the frame, if its file states it
  std::optional<std::int64_t> step;     ///< of the simulation, if its file states it
  std::vector<std::string> assemblies;  ///< of its sphere file: as SphereFile::assemblies
  std::vector<std::string> rules;       ///< changes made to its spheres, one sentence each
  /// Of a style for points by their density; the spheres have its values. Their radius without it, if it has another.
  std::optional<Density> density;
  std::optional<double> radius_without_density;
  Vec3d recentred_by;  ///< subtracted from every centre; 0 without `recenter`
  std::vector<std::string> warnings;
  std::vector<std::string> files;  ///< paths of other files that were read
  std::vector<Look> looks;         ///< the document's; already applied, unless LooksOfFile::keep was given
};

/// Whether a document's looks are applied while it is read, or kept for a caller who adds more.
enum class LooksOfFile { apply, keep };

/// `name` is the file's name for messages; relative paths in the document start from its folder. The options apply to
/// inline spheres and to a sphere file of the document alike, and override the document. If only the options recentre,
/// camera, lights and plane move along. Errors name the path inside the document (/materials/0/power) and the expected
/// value.
/// `style`: the default appearance; null: plain.
Result<LoadedScene> parse_scene(std::string_view json, const std::string& name, const ReadOptions& options,
                                LooksOfFile looks = LooksOfFile::apply, const Style* style = nullptr);

/// Whether the bytes may be a scene document (first character after white space is '{').
bool looks_like_scene(std::string_view bytes);

/// A complete document with the spheres inline; parse_scene() gives back an equal scene.
std::string scene_to_json(const Scene& scene);

/// The JSON Schema itself, as text.
std::string_view scene_schema();

}  // namespace bihive
