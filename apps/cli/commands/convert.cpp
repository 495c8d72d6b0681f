// bihive convert: writes the spheres as they were read into a file of another format.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bihive/io/bonds.h"
#include "bihive/io/write_spheres.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/selection.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/looks.h"
#include "bihive/scene/scene_file.h"
#include "commands/commands.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/write_together.h"

namespace bihive::cli {
namespace {

struct OutputFormat {
  const char* name;
  const char* ending;
  const char* shown;
  std::optional<SphereFileFormat> format;  // none: a scene file
};
const OutputFormat kOutputFormats[] = {
    {"xyz", ".xyz", "XYZ", SphereFileFormat::xyz},
    {"extxyz", ".extxyz", "extended XYZ", SphereFileFormat::extended_xyz},
    {"csv", ".csv", "CSV", SphereFileFormat::csv},
    {"npy", ".npy", "NPY", SphereFileFormat::npy},
    {"ply", ".ply", "PLY", SphereFileFormat::ply},
    {"sdf", ".sdf", "SDF", SphereFileFormat::sdf},
    {"sdf", ".mol", "a MOL file", SphereFileFormat::sdf},
    {"mol2", ".mol2", "MOL2", SphereFileFormat::mol2},
    {"scene", ".json", "a scene file", std::nullopt},
};

const OutputFormat& output_format(const ConvertOptions& options) {
  const std::string ending = std::filesystem::path(options.output).extension().string();
  for (const OutputFormat& format : kOutputFormats)
    if (options.format.empty() ? ending == format.ending : options.format == format.name) return format;
  if (options.output == kStandardStream)
    fail_usage("the standard output has no ending: say --format xyz|extxyz|csv|npy|ply|sdf|mol2|scene");
  fail_usage("the output's name must end in .xyz, .extxyz, .csv, .npy, .ply, .sdf, .mol, .mol2 or .json",
             "or say --format xyz|extxyz|csv|npy|ply|sdf|mol2|scene");
}

// Removes the spheres that the expression does not select.
void keep_selected(Scene& scene, const std::string& expression) {
  const std::vector<std::uint8_t> mask = selected_or_fail(scene.spheres, expression, "select");
  const std::int64_t count = std::count(mask.begin(), mask.end(), std::uint8_t{1});
  if (count == 0) fail({"no sphere is selected by " + expression, "", 0, 0, "bihive select counts"});
  if (count == scene.spheres.size()) return;
  value_or_fail(apply_looks(scene, {{"all", {SetShown{false}}}, {expression, {SetShown{true}}}}));
}

// A whole scene: with a camera and lights as bihive render places them in plain style.
std::string scene_file(Input& input) {
  Scene& scene = input.scene;
  if (!input.has_camera)
    scene.camera =
        frame_spheres(scene.spheres, side_of(ViewFrom::front), {}, scene.picture.width_px, scene.picture.height_px);
  if (!input.has_lights) {
    scene.ambient_light = input.rig.ambient_light;
    scene.lights = lights_around(input.rig, scene.camera);
  }
  return scene_to_json(scene);
}

void report(const ConvertOptions& options, const OutputFormat& format, const Input& input, std::size_t bytes,
            const std::vector<std::string>& left_out) {
  const std::int64_t count = input.scene.spheres.size();
  if (options.json) {
    nlohmann::ordered_json json;
    json["input"] = options.input.input;
    json["input_format"] = input.format;
    json["output"] = options.output;
    json["format"] = format.name;
    json["spheres"] = count;
    json["bytes"] = bytes;
    json["left_out"] = left_out;
    return print(json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  std::string text =
      fmt::format("{}: {} as {}, {}\n", escaped(options.output), grouped(count) + (count == 1 ? " sphere" : " spheres"),
                  format.shown, readable_bytes(double(bytes)));
  for (const std::string& rule : input.rules)
    if (rule.starts_with("order: ")) text += "  " + escaped(rule) + "\n";
  for (const std::string& one : left_out) text += "  not as it was: " + escaped(one) + "\n";
  print_report(text, {options.output});
}

}  // namespace

void run_convert(const ConvertOptions& options) {
  const OutputFormat& format = output_format(options);
  if (options.json && on_standard_output({options.output}))
    fail_usage("--json and -o - would share the standard output");
  if (format.format) refuse_copies(options.input, std::string(format.shown) + " holds the stored spheres");
  const bool is_text = format.format != SphereFileFormat::npy && format.format != SphereFileFormat::ply;
  check_outputs(outputs_of(options), inputs_of(options), is_text);

  // The colours of a scheme are bihive's, not the file's.
  Input input = load_input(options.input);
  check_outputs(outputs_of(options), input.files, is_text);
  if (input.has_scheme_colours && format.format) input.scene.spheres.attributes().colour.clear();
  if (!options.select.empty()) keep_selected(input.scene, options.select);

  WrittenSpheres written;
  if (format.format) {
    const bool is_molecule = format.format == SphereFileFormat::sdf || format.format == SphereFileFormat::mol2;
    // Readers of these formats look for no bonds by distance.
    const std::int64_t added = is_molecule ? value_or_fail(state_bonds(input.scene.spheres, Sticks().reach)) : 0;
    written = write_spheres(input.scene.spheres, *format.format, input.title);
    if (added > 0)
      written.left_out.push_back(
          fmt::format("{} bond{} found by distance", grouped(added), added == 1 ? " is" : "s are"));
    if (input.scene.spheres.has_images()) written.left_out.emplace_back("the copies along the cell");
  } else {
    written.bytes = scene_file(input);
    const SphereAttributes& attributes = input.scene.spheres.attributes();
    if (!attributes.numbers.empty() || !attributes.texts.empty() || !attributes.type.empty() ||
        !attributes.element.empty())
      written.left_out.push_back(
          "elements, types, numbers and texts: a scene file holds colours and materials instead");
  }
  write_together({{output_path(options.output), written.bytes}});
  report(options, format, input, written.bytes.size(), written.left_out);
}

}  // namespace bihive::cli
