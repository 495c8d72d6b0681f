#include "control_names.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "bihive/io/reading_settings.h"
#include "bihive/settings/parameter.h"

namespace bihive::page {
namespace {

struct Control {
  std::string_view id, label;
};

// The labels in web/index.html of controls that no table of the library has.
constexpr std::array kControls{Control{"aperture", "Aperture"},
                               Control{"background", "Background"},
                               Control{"colour_by", "Colour by"},
                               Control{"count", "Spheres"},
                               Control{"element_colours", "Elements"},
                               Control{"engine", "Engine"},
                               Control{"focus", "Sharp"},
                               Control{"fov", "Angle"},
                               Control{"light", "Lights"},
                               Control{"max_depth", "max_depth"},
                               Control{"max_prims", "max_prims"},
                               Control{"nan_colour", "Unknown numbers"},
                               Control{"projection", "Projection"},
                               Control{"samples", "Samples"},
                               Control{"style", "Style"},
                               Control{"view", "View"}};

std::string label_of(std::string_view id) {
  const auto at = std::find_if(kControls.begin(), kControls.end(), [id](const Control& one) { return one.id == id; });
  if (at != kControls.end()) return std::string(at->label);
  if (const ReadingSetting* const row = reading_setting(id); row != nullptr) return std::string(row->label);
  const Parameter* const parameter = parameter_named(id);
  std::string label(parameter == nullptr ? "" : parameter->label);
  if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return label;
}

}  // namespace

std::string control_name(std::string_view id) {
  const std::string label = label_of(id);
  return label.empty() ? std::string(id) : "“" + label + "” in the panel";
}

}  // namespace bihive::page
