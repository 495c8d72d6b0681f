// From what a user names to a scene: a built-in name, or the bytes of a scene file or of a file of spheres.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/scene_file.h"

namespace bihive {

constexpr std::array<const char*, 5> kBuiltInScenes{"demo", "scenario1", "scenario2", "scenario3", "four-spheres"};
bool is_built_in_scene(const std::string& name);

/// Error: so many spheres do not fit this machine's memory.
Status check_scenario_memory(const ScenarioParameters& parameters);

/// One of kBuiltInScenes. The parameters are the scenarios', the options the demo's; others ignore them. Error: an
/// unknown name (its message lists them), or parameters out of range, or so many
/// spheres that they do not fit.
Result<LoadedScene> built_in_scene(const std::string& name, const ScenarioParameters& parameters = {},
                                   const ReadOptions& options = {});

/// A scene file where the bytes look like one, else spheres of any known format, coloured by element or type. `name` is
/// the file's, as for parse_scene() and read_spheres_from_memory().
Result<LoadedScene> load_scene(std::string_view bytes, const std::string& name, const ReadOptions& options = {});

}  // namespace bihive
