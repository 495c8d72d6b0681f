// bihive scene: writes a scene of the thesis to a file. bihive scene save: writes the request for a picture.

#include "bihive/scene/scene.h"

#include <fmt/format.h>

#include "bihive/io/npy.h"
#include "bihive/job/failure.h"
#include "bihive/job/figure.h"
#include "bihive/job/messages.h"
#include "bihive/job/scene_request.h"
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

void run_scene_save(const SceneSaveOptions& options) {
  const RenderOptions& asked = options.picture;
  const std::string& output = asked.output;
  if (!ends_with(output, ".json") && output != kStandardStream)
    fail_usage("the name of a scene file must end in .json", "- writes it to the standard output");
  // The request of a figure, or what is asked for.
  PictureRequest request = asked;
  const std::string& input = asked.input.input;
  if (!is_built_in_scene(input) && input != kStandardStream && looks_like_figure(input)) {
    const Figure figure = read_figure(input);
    const std::vector<std::string>& layers = figure.record.layers;
    if (!layers.empty() && layers != std::vector<std::string>{"radiance"})
      fail({"has layers, which a scene file does not hold", input, 0, 0, "draw it from the input by bihive render"});
    if (figure.record.fixed)
      fail({"is a picture of a film, whose camera a scene file does not hold", input, 0, 0,
            "save the request for its input"});
    request = request_again(figure, input, "", asked.given);
  } else {
    take_saved_request(request);
  }
  check_outputs(outputs_of(options), inputs_of(options));
  write_together({{output_path(output), scene_of_request(request, output)}});
  print_report(fmt::format("{}: {}, {} options\n", escaped(output), escaped(request.input.input), request.given.size()),
               {output});
}

}  // namespace bihive::cli
