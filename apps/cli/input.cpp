#include "input.h"

#include <unistd.h>

#include "bihive/base/write_file.h"
#include "bihive/bih/memory.h"
#include "bihive/io/bundled.h"
#include "bihive/io/read_spheres.h"
#include "bihive/kernels/wide_builder.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/palette.h"
#include "bihive/scene/scene_file.h"
#include "failure.h"
#include "messages.h"

namespace bihive::cli {
namespace {

// Bytes a sphere of a generated scene: three growing arrays and radii, the set itself, materials.
constexpr double kBytesPerGeneratedSphere = 3 * 4 * 1.5 + 4 + 16 + 4;

void only_for(bool given, const std::string& option, const std::string& what, const std::string& input) {
  if (given) fail_usage(option + " is for " + what + ", not for " + input);
}

void refuse_generator_options(const InputOptions& options) {
  only_for(options.count.has_value(), "--count", "scenario1, scenario2 and scenario3", options.input);
  only_for(options.seed.has_value(), "--seed", "scenario1, scenario2 and scenario3", options.input);
}

void refuse_file_options(const InputOptions& options) {
  only_for(options.radius_scale.has_value(), "--radius-scale", "files", options.input);
  only_for(options.recenter, "--recenter", "files", options.input);
  only_for(options.frame.has_value(), "--frame", "files", options.input);
}

ReadOptions read_options(const InputOptions& options) {
  ReadOptions reading;
  reading.radius = options.radius;
  reading.radius_scale = options.radius_scale.value_or(1);
  reading.recenter = options.recenter;
  reading.frame = options.frame.value_or(0);
  return reading;
}

Input from_sphere_file(SphereFile file, const std::string& name) {
  Input input;
  input.scene.spheres = std::move(file.spheres);
  input.scene.name = name;
  input.format = file.format;
  input.frames = file.frames;
  input.rules = std::move(file.rules);
  input.warnings = std::move(file.warnings);
  input.recentred_by = file.recentred_by;
  colour_spheres(input.scene.spheres);
  return input;
}

Input from_scene_file(LoadedScene loaded) {
  Input input;
  input.scene = std::move(loaded.scene);
  input.has_camera = loaded.has_camera;
  input.has_lights = loaded.has_lights;
  input.format = "scene file";
  input.frames = loaded.frames;
  input.rules = std::move(loaded.rules);
  input.warnings = std::move(loaded.warnings);
  input.recentred_by = loaded.recentred_by;
  return input;
}

}  // namespace

std::optional<Scene> generated_scene(const InputOptions& options) {
  const std::string& name = options.input;
  const bool scenario = name == "scenario1" || name == "scenario2" || name == "scenario3";
  if (!scenario && name != "four-spheres") return std::nullopt;
  refuse_file_options(options);
  if (!scenario) {
    refuse_generator_options(options);
    only_for(options.radius.has_value(), "--radius", "the scenarios and files", name);
    return four_spheres_scene();
  }
  ScenarioParameters parameters;
  parameters.count = options.count.value_or(parameters.count);
  if (options.radius) parameters.radius = static_cast<float>(*options.radius);
  parameters.seed = options.seed.value_or(parameters.seed);
  check_memory(static_cast<double>(parameters.count) * kBytesPerGeneratedSphere, "so many spheres");
  Result<Scene> scene = scenario_scene(static_cast<Scenario>(name.back() - '0'), parameters);
  if (!scene) fail_usage(name + ": " + scene.error().message, scene.error().hint);
  // Scenario 1 has the same spheres for every seed, but reports the one that it was asked for.
  scene->seed = parameters.seed;
  return std::move(*scene);
}

Input load_input(const InputOptions& options) {
  Input input;
  if (std::optional<Scene> scene = generated_scene(options)) {
    input.scene = std::move(*scene);
    input.has_camera = true;
    input.has_lights = true;
    input.format = "built-in";
  } else if (options.input == "demo") {
    refuse_generator_options(options);
    input = from_sphere_file(value_or_fail(read_spheres_from_memory(bundled_molecule(), "demo", read_options(options))),
                             "demo");
  } else {
    refuse_generator_options(options);
    const std::string bytes = value_or_fail(read_file(options.input));
    input = looks_like_scene(bytes)
                ? from_scene_file(value_or_fail(parse_scene(bytes, options.input, read_options(options))))
                : from_sphere_file(value_or_fail(read_spheres_from_memory(bytes, options.input, read_options(options))),
                                   options.input);
  }
  warn(input.warnings);
  return input;
}

void check_memory(double bytes, const std::string& what) {
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes > machine)
    fail({what + " would take about " + readable_bytes(bytes) + " of memory, and this machine has " +
              readable_bytes(machine),
          "", 0, 0, ""});
}

void check_tree_memory(const SphereSet& spheres, const BuildParameters& parameters) {
  const MemoryPrediction prediction = predict_tree_memory(spheres.size(), parameters);
  check_memory(static_cast<double>(prediction.allocated_bytes.low),
               "the tree of " + grouped(spheres.size()) + " spheres");
}

void check_tree_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters) {
  if (engine == Engine::brute) return;
  if (engine == Engine::reference) return check_tree_memory(spheres, parameters.for_reference());
  const WideMemoryPrediction prediction = predict_wide_memory(spheres.size(), parameters.for_wide(spheres.size()));
  check_memory(static_cast<double>(prediction.low_bytes), "the tree of " + grouped(spheres.size()) + " spheres");
}

}  // namespace bihive::cli
