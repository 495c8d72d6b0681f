// Makes a scene of a user's input: a built-in name, or the bytes of a scene file or of a file of spheres.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"

namespace bihive {

/// What the parameters of built_in_scene() change.
enum class BuiltInKind { file, scenario, fixed };

struct BuiltInScene {
  const char* name;
  const char* title;  ///< for lists
  BuiltInKind kind;
};

constexpr std::array<BuiltInScene, 5> kBuiltInScenes{{{"demo", "HIV-1 protease with amprenavir", BuiltInKind::file},
                                                      {"scenario1", "Scenario 1: grid", BuiltInKind::scenario},
                                                      {"scenario2", "Scenario 2: clusters", BuiltInKind::scenario},
                                                      {"scenario3", "Scenario 3: both", BuiltInKind::scenario},
                                                      {"four-spheres", "Four spheres", BuiltInKind::fixed}}};
bool is_built_in_scene(const std::string& name);

/// Error: this number of spheres does not fit this machine's memory.
Status check_scenario_memory(const ScenarioParameters& parameters);

/// One of kBuiltInScenes. The parameters are for the scenarios, the options for the file; other scenes ignore them.
/// Error: an unknown name (the message lists all names), parameters out of range, or more spheres than memory holds.
/// `style`: of the demo; null: plain.
Result<LoadedScene> built_in_scene(const std::string& name, const ScenarioParameters& parameters = {},
                                   const ReadOptions& options = {}, const Style* style = nullptr);

/// A scene file if the bytes look like one, else spheres of any known format, coloured by element or type. `name` is
/// the file's, as for parse_scene() and read_spheres_from_memory().
/// `style` is the default appearance; null: plain.
Result<LoadedScene> load_scene(std::string_view bytes, const std::string& name, const ReadOptions& options = {},
                               LooksOfFile looks = LooksOfFile::apply, const Style* style = nullptr);

/// The scene of spheres that were read, as load_scene() makes it: for frames (io/frames.h). `name` is the scene's.
LoadedScene scene_of_spheres(SphereFile file, const std::string& name, const Style* style = nullptr);

/// Gives spheres of a file (not of a scene file) another style than the one they were loaded with: the scene becomes
/// what load_scene() makes with it. No look must have been applied yet.
void restyle(LoadedScene& loaded, const Style& style);

}  // namespace bihive
