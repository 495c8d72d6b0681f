// bihive view: passes a checked command line on to bihive-view, the program with the window.

#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/job/failure.h"
#include "bihive/job/input.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/scene/names.h"
#include "commands/commands.h"
#include "commands/picture_file.h"
#include "commands/shown_state.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/sibling_program.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kProgram = "bihive-view";
constexpr const char* kFirstInput = "demo";  // shown if no input is given
// The JSON object of apps/viewer/request.h.
ordered_json request_of(const ViewOptions& options, bool names_none) {
  ordered_json request = ordered_json::object();
  const InputOptions& input = options.input;
  request["input"] = input.input == kStandardStream ? "/dev/stdin" : input.input;
  if (input.count) request["count"] = *input.count;
  if (input.seed) request["seed"] = *input.seed;
  request["reading"] = *json_from_text<ordered_json>(reading_to_json(input.reading));
  if (options.size) request["size"] = {options.size->width_px, options.size->height_px};
  if (options.view_from) request["view_from"] = name_of(kSides, *options.view_from);
  request["look"] = look_to_show(options);
  if (options.tune) request["tune"] = true;
  if (names_none) request["welcome"] = true;
  if (!options.card.empty()) request["card"] = options.card;
  if (!options.screenshot.empty()) request["screenshot"] = options.screenshot;
  request["settings"] = settings_to_show(options, /*with_side=*/false);
  return request;
}

}  // namespace

void run_view(const ViewOptions& asked) {
  ViewOptions options = asked;
  const bool names_none = options.input.input.empty();
  if (names_none) options.input.input = kFirstInput;
  take_request_to_show(options, /*of_page=*/false);
  if (options.window_engine == ViewerEngine::gpu && options.view == View::tree)
    fail_usage("--view tree is drawn by the CPU, and --engine gpu is not",
               "leave --engine out, or choose --engine cpu");
  if (options.tune) {
    const bool is_gpu = options.window_engine == ViewerEngine::gpu;
    check_tuning(options.tree, name_of(kViewerEngines, options.window_engine.value_or(ViewerEngine::cpu)), !is_gpu);
    check_tuned_view(options.view);
  }
  check_shown(options);
  if (!options.screenshot.empty()) {
    check_picture_name(options.screenshot);
    if (options.screenshot == kStandardStream || is_exr(options.screenshot) || is_tiff(options.screenshot))
      fail_usage("--screenshot writes a PNG file", "name one that ends in .png");
    check_outputs(outputs_of(options), inputs_of(options));
  }
  const std::string request =
      request_of(options, names_none).dump(-1, ' ', false, ordered_json::error_handler_t::ignore);

  const char* const words[] = {kProgram, request.c_str(), nullptr};
  become_program(
      kProgram, words,
      "it is built where GLFW and Dear ImGui are: scripts/setup view, then make demo, or configure and build again");
}

}  // namespace bihive::cli
