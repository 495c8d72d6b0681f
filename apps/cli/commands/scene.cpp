// bihive scene: writes a scene of the thesis to a file.

#include "bihive/scene/scene.h"

#include <fmt/format.h>

#include "bihive/io/npy.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/scene/scene_file.h"
#include "commands/commands.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/write_together.h"

namespace bihive::cli {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// x, y, z, r of each sphere in world units.
std::string npy_of(const SphereSet& spheres) {
  std::vector<float> rows;
  rows.reserve(4 * static_cast<std::size_t>(spheres.size()));
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3f centre = to_float(spheres.centre(id));
    rows.insert(rows.end(), {centre.x, centre.y, centre.z, static_cast<float>(spheres.radius(id))});
  }
  return npy_bytes(rows, {spheres.size(), 4});
}

}  // namespace

void run_scene(const SceneOptions& options) {
  const bool npy = ends_with(options.output, ".npy");
  if (!npy && !ends_with(options.output, ".json") && options.output != kStandardStream)
    fail_usage("the output's name must end in .npy (spheres alone) or .json (a scene file)",
               "- writes a scene file to the standard output");
  check_outputs(outputs_of(options), {});
  const std::optional<Scene> scene = generated_scene(options.input);
  if (!scene)
    fail_usage("expected scenario1, scenario2, scenario3 or four-spheres, found \"" + options.input.input + "\"");

  const std::string bytes = npy ? npy_of(scene->spheres) : scene_to_json(*scene);
  write_together({{output_path(options.output), bytes}});
  const std::string seed = scene->seed ? fmt::format(", seed {}", *scene->seed) : "";
  print_report(
      fmt::format("{}: {}, {} spheres{}\n", escaped(options.output), scene->name, grouped(scene->spheres.size()), seed),
      {options.output});
}

}  // namespace bihive::cli
