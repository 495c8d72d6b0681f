#include "bihive/scene/load_scene.h"

#include <algorithm>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/bundled.h"
#include "bihive/io/packed.h"
#include "bihive/scene/creases.h"
#include "bihive/scene/default_colours.h"
#include "bihive/scene/load_spheres.h"
#include "bihive/scene/show_density.h"

namespace bihive {
namespace {

// Bytes per sphere of a generated scene: three growing arrays and radii, the set itself, materials.
constexpr double kBytesPerGeneratedSphere = 3 * 4 * 1.5 + 4 + 16 + 4;

Result<LoadedScene> from_spheres(Result<SphereFile> file, const std::string& name, const Style* style) {
  if (!file) return file.error();
  return scene_of_spheres(std::move(*file), name, style);
}

LoadedScene generated(Scene scene) {
  LoadedScene loaded;
  loaded.scene = std::move(scene);
  loaded.has_camera = true;
  loaded.has_lights = true;
  loaded.format = "built-in";
  return loaded;
}

}  // namespace

LoadedScene scene_of_spheres(SphereFile file, const std::string& name, const Style* style) {
  LoadedScene loaded;
  loaded.scene.spheres = std::move(file.spheres);
  loaded.scene.name = name;
  loaded.format = file.format;
  loaded.title = std::move(file.title);
  loaded.entry_id = std::move(file.entry_id);
  loaded.frames = file.frames;
  loaded.time_ps = file.time_ps;
  loaded.step = file.step;
  loaded.assemblies = std::move(file.assemblies);
  loaded.rules = std::move(file.rules);
  loaded.warnings = std::move(file.warnings);
  loaded.recentred_by = file.recentred_by;
  loaded.has_assumed_radii = file.assumed_radii;
  loaded.has_scheme_colours = loaded.scene.spheres.attributes().colour.empty();
  if (style != nullptr)
    restyle(loaded, *style);
  else
    take_default_colours(loaded.scene, loaded.format, nullptr);
  return loaded;
}

void restyle(LoadedScene& loaded, const Style& style) {
  show_density(loaded, std::nullopt);
  apply_style(style, loaded.scene);
  loaded.rig = style.lights;
  if (loaded.has_scheme_colours) loaded.scene.spheres.attributes().colour.clear();
  loaded.scene.coloured_by.clear();
  loaded.scene.coloured_by_of_sphere.clear();
  loaded.scene.legend_names.clear();
  take_default_colours(loaded.scene, loaded.format, &style);
  take_density(loaded, style);
  loaded.scene.spheres.attributes().crease.clear();
  if (style.crease.empty()) return;
  if (Result<std::vector<std::int32_t>> groups = crease_groups(loaded.scene.spheres, style.crease))
    loaded.scene.spheres.attributes().crease = std::move(*groups);
}

bool is_built_in_scene(const std::string& name) {
  return std::any_of(kBuiltInScenes.begin(), kBuiltInScenes.end(),
                     [&name](const BuiltInScene& one) { return name == one.name; });
}

Status check_scenario_memory(const ScenarioParameters& parameters) {
  return check_memory(static_cast<double>(parameters.count) * kBytesPerGeneratedSphere, "this many spheres");
}

Result<LoadedScene> built_in_scene(const std::string& name, const ScenarioParameters& parameters,
                                   const ReadOptions& options, const Style* style) {
  if (name == "demo") return from_spheres(read_spheres_from_memory(bundled_molecule(), name, options), name, style);
  if (name == "four-spheres") return generated(four_spheres_scene());
  if (!is_built_in_scene(name)) {
    std::string known;
    for (const BuiltInScene& one : kBuiltInScenes) known += (known.empty() ? "" : ", ") + std::string(one.name);
    return Error{"there is no built-in scene \"" + name + "\"", "", 0, 0, "there are " + known};
  }
  if (Status status = check_scenario_memory(parameters); !status) return status.error();
  Result<Scene> scene = scenario_scene(static_cast<Scenario>(name.back() - '0'), parameters);
  if (!scene) {
    Error error = scene.error();
    if (error.file.empty()) error.file = name;
    return error;
  }
  // Scenario 1 has the same spheres for every seed, but reports the given seed.
  scene->seed = parameters.seed;
  return generated(std::move(*scene));
}

Result<LoadedScene> load_scene(std::string_view bytes, const std::string& name, const ReadOptions& options,
                               LooksOfFile looks, const Style* style) {
  if (is_packed(bytes)) {
    const Result<std::string> unpacked = unpack_if_packed(std::string(bytes), name);
    if (!unpacked) return unpacked.error();
    return load_scene(*unpacked, name, options, looks, style);
  }
  if (looks_like_scene(bytes)) return parse_scene(bytes, name, options, looks, style);
  return from_spheres(read_spheres_from_memory(bytes, name, options), name, style);
}

Result<LoadedScene> load_spheres(const std::string& path, const ReadOptions& options, const Style* style) {
  return from_spheres(read_spheres(path, options), path, style);
}

}  // namespace bihive
