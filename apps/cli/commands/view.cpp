// bihive view: passes a checked command line on to bihive-view, the program with the window.

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bihive/scene/style.h"
#include "bihive/viewer/viewer_settings.h"
#include "commands/commands.h"
#include "commands/names.h"
#include "commands/picture_file.h"
#include "support/failure.h"
#include "support/input.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kProgram = "bihive-view";

// The JSON object of apps/viewer/request.h.
ordered_json request_of(const ViewOptions& options) {
  ordered_json request = ordered_json::object();
  const auto put = [](ordered_json& object, const char* key, const auto& value) {
    if (value) object[key] = *value;
  };
  const InputOptions& input = options.input;
  request["input"] = input.input == kStandardStream ? "/dev/stdin" : input.input;
  put(request, "count", input.count);
  put(request, "seed", input.seed);
  put(request, "radius", input.radius);
  put(request, "radius_scale", input.radius_scale);
  put(request, "frame", input.frame);
  if (!input.trajectory.empty()) request["trajectory"] = input.trajectory;
  if (input.recenter) request["recenter"] = true;
  if (!input.assembly.empty()) request["assembly"] = input.assembly;
  put(request, "replicate", input.replicate);
  if (input.cell_vectors)
    for (const Vec3d& v : *input.cell_vectors) request["cell_vectors"].push_back({v.x, v.y, v.z});
  if (input.cell_origin) request["cell_origin"] = {input.cell_origin->x, input.cell_origin->y, input.cell_origin->z};
  if (input.wrapping != Wrapping::none) request["wrapping"] = input.wrapping == Wrapping::wrap ? "wrap" : "unwrap";
  if (options.size) request["size"] = {options.size->width_px, options.size->height_px};
  if (options.view_from) request["view_from"] = name_of(kSides, *options.view_from);
  if (!options.style.empty()) request["style"] = options.style;
  if (!options.screenshot.empty()) request["screenshot"] = options.screenshot;

  const auto limit = [](std::int64_t value) {
    return value == kUnlimited ? ordered_json("unlimited") : ordered_json(value);
  };
  ordered_json settings = ordered_json::object();
  settings["view"] = name_of(kViews, options.view);
  if (options.engine) settings["engine"] = name_of(kViewerEngines, *options.engine);
  put(settings, "recursion", options.recursion);
  put(settings, "samples_per_pixel", options.samples);
  put(settings, "shadows", options.shadows);
  if (options.tree.max_prims) settings["max_prims"] = limit(*options.tree.max_prims);
  if (options.tree.max_depth) settings["max_depth"] = limit(*options.tree.max_depth);
  request["settings"] = settings;
  return request;
}

void check_style(const ViewOptions& options) {
  if (options.style.empty()) return;
  if (const Result<Style> style = style_named(options.style); !style)
    fail_usage("--style: " + style.error().message, "see bihive styles");
  const std::string& input = options.input.input;
  if (is_built_in_scene(input) && input != "demo") fail_usage("--style is for files, not for " + input);
}

}  // namespace

void run_view(const ViewOptions& options) {
  if (options.engine == ViewerEngine::gpu && options.view == View::tree)
    fail_usage("--view tree is drawn by the CPU, and --engine gpu is not",
               "leave --engine out, or choose --engine cpu");
  check_input_options(options.input);
  check_style(options);
  if (!options.screenshot.empty()) {
    check_picture_name(options.screenshot);
    if (options.screenshot == kStandardStream || is_exr(options.screenshot))
      fail_usage("--screenshot writes a PNG file", "name one that ends in .png");
    check_outputs({options.screenshot}, {file_of(options.input), options.input.trajectory});
  }
  const std::string request = request_of(options).dump(-1, ' ', false, ordered_json::error_handler_t::ignore);

  // The program lies beside this one, or in the PATH of the shell.
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string beside = unknown ? "" : (self.parent_path() / kProgram).string();
  if (!beside.empty()) execl(beside.c_str(), kProgram, request.c_str(), static_cast<char*>(nullptr));
  const int reason = beside.empty() ? ENOENT : errno;
  if (reason == ENOENT) execlp(kProgram, kProgram, request.c_str(), static_cast<char*>(nullptr));
  if (errno != ENOENT) throw Failure{kEnvironment, {std::string(std::strerror(errno)), beside, 0, 0, ""}};
  throw Failure{
      kEnvironment,
      {"the program with the window, bihive-view, is not installed", "", 0, 0,
       "it is built where GLFW and Dear ImGui are: scripts/setup view, then make demo, or configure and build again"}};
}

}  // namespace bihive::cli
