#include "commands/choose_labels.h"

#include <string>

#include "bihive/render/draw_labels.h"
#include "support/failure.h"
#include "support/messages.h"

namespace bihive::cli {
namespace {

// Takes one label out where the picture cannot have it.
void check_one(bool Labels::*label, bool asked_for, const std::string& option, const Scene& scene,
               RenderSettings& settings) {
  RenderSettings alone = settings;
  alone.labels = {};
  alone.labels.*label = settings.labels.*label;
  const Status status = check_labels(scene, alone);
  if (status) return;
  if (asked_for) fail_usage(option + ": " + status.error().message, status.error().hint);
  warn("left out, as " + option + " would be: " + status.error().message);
  settings.labels.*label = false;
}

}  // namespace

void take_labels(const LabelOptions& options, Labels& labels) {
  if (options.none) labels = {};
  labels.legend = labels.legend || options.legend;
  labels.scale_bar = labels.scale_bar || options.scale_bar;
  labels.axes = labels.axes || options.axes;
  labels.title = options.title.value_or(labels.title);
  if (options.length_unit) labels.length_unit = options.length_unit;
  if (options.length_unit && !labels.scale_bar)
    fail_usage("--length-unit is for the scale bar, and the picture has none", "add --scale-bar, or leave it out");
}

void leave_out_labels(const LabelOptions& options, const Scene& scene, RenderSettings& settings) {
  check_one(&Labels::legend, options.legend, "--legend", scene, settings);
  check_one(&Labels::scale_bar, options.scale_bar, "--scale-bar", scene, settings);
}

}  // namespace bihive::cli
