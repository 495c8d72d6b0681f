#include "bihive/job/choose_labels.h"

#include <string_view>

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/render/draw_labels.h"

namespace bihive {
namespace {

// Removes one label if the picture cannot have it.
void check_one(bool Labels::*label, bool asked_for, std::string_view id, const Scene& scene, RenderSettings& settings) {
  RenderSettings alone = settings;
  alone.labels = {};
  alone.labels.*label = settings.labels.*label;
  const Status status = check_labels(scene, alone);
  if (status) return;
  if (asked_for) fail_setting(id, ": " + status.error().message, status.error().hint);
  warn("left out, as " + setting_name(id) + " would be: " + status.error().message);
  settings.labels.*label = false;
}

}  // namespace

void leave_out_labels(const Overrides& user, const Scene& scene, RenderSettings& settings) {
  check_one(&Labels::legend, user.is_on("legend"), "legend", scene, settings);
  check_one(&Labels::scale_bar, user.is_on("scale_bar"), "scale_bar", scene, settings);
}

}  // namespace bihive
