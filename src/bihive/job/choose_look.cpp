#include "bihive/job/choose_look.h"

#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"

namespace bihive {
namespace {

// A style's name has neither a folder nor an ending.
bool is_path(const std::string& style) {
  return style.find('/') != std::string::npos || style.find('.') != std::string::npos;
}

}  // namespace

Style choose_style(const StyleOptions& options) {
  const std::string& wanted = options.name.empty() ? style_names().front() : options.name;
  if (is_path(wanted)) return value_or_fail(parse_style(value_or_fail(read_file(wanted)), wanted));
  Result<Style> style = style_named(wanted);
  if (!style) fail_setting("style", ": " + style.error().message, style.error().hint);
  return std::move(*style);
}

void apply_look(const StyleOptions& options, Input& input) {
  Scene& scene = input.scene;
  if (options.lights.empty()) {
    if (!input.has_lights) scene.lights = lights_around(input.rig, scene.camera);
    return;
  }
  const LightRig rig = rig_of(options.lights, scene.ambient_light);
  scene.lights = lights_around(rig, scene.camera);
  scene.ambient_light = rig.ambient_light;
}

}  // namespace bihive
