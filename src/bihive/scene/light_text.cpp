#include "bihive/scene/light_text.h"

#include <variant>

#include "bihive/base/parse_number.h"
#include "bihive/image/colour_text.h"
#include "bihive/math/vector_text.h"
#include "bihive/scene/look_text.h"

namespace bihive {
namespace {

constexpr double kStrongest = 1e6;
constexpr double kFarthest = 1e18;
constexpr double kWidestDeg = 90;

std::string ways_to_say() {
  std::string names;
  for (const auto& preset : light_presets()) names += preset.first + ", ";
  return names + "from:RIGHT,UP,TOWARDS[:COLOUR[:STRENGTH[:DEG]]], at:X,Y,Z[:COLOUR[:STRENGTH[:RADIUS]]]";
}

Result<double> number_in(const std::string& text, double most, const std::string& meaning) {
  const std::optional<double> number = parse_double(text);
  if (number && *number >= 0 && *number <= most) return *number;
  return unexpected(meaning, text);
}

Result<Vec3d> vector_in(std::string_view text) {
  if (const std::optional<Vec3d> vector = vector_from_text(text, -kFarthest, kFarthest)) return *vector;
  return unexpected("three numbers from -1e18 to 1e18 as X,Y,Z", text);
}

// Field number N, or nothing if the text has fewer fields or the field is empty.
std::string part(const std::vector<std::string_view>& parts, std::size_t i) {
  return std::string(i < parts.size() ? parts[i] : std::string_view());
}

Result<Vec3d> light_in(const std::vector<std::string_view>& parts) {
  Vec3d light{1, 1, 1};
  if (const std::string colour = part(parts, 2); !colour.empty()) {
    const Result<ColourChoice> choice = colour_choice_from_text(colour);
    if (!choice) return choice.error();
    const Vec3d* linear = std::get_if<Vec3d>(&*choice);
    light = linear != nullptr ? *linear : *colour_from_text(colour, Transfer::srgb);
  }
  if (const std::string strength = part(parts, 3); !strength.empty()) {
    const Result<double> factor = number_in(strength, kStrongest, "a strength from 0 to 1e6");
    if (!factor) return factor.error();
    light = *factor * light;
  }
  return light;
}

}  // namespace

Status add_light(const std::string& text, LightChoice& choice) {
  if (const LightRig* preset = value_named(light_presets(), text)) {
    if (choice.preset) return Error{"there is a preset already", "", 0, 0, "a preset goes with single lights"};
    choice.preset = *preset;
    return Done{};
  }
  const std::vector<std::string_view> parts = parts_of(text, ':');
  const bool is_placed = parts[0] == "at";
  if ((!is_placed && parts[0] != "from") || parts.size() < 2 || parts.size() > 5)
    return unexpected("one of " + ways_to_say(), text);
  const Result<Vec3d> where = vector_in(parts[1]);
  if (!where) return where.error();
  const Result<Vec3d> light = light_in(parts);
  if (!light) return light.error();
  double size = 0;
  if (const std::string last = part(parts, 4); !last.empty()) {
    const Result<double> number = is_placed ? number_in(last, kFarthest, "a radius from 0 to 1e18")
                                            : number_in(last, kWidestDeg, "an angle from 0 to 90");
    if (!number) return number.error();
    size = *number;
  }

  if (is_placed) {
    choice.placed.push_back({*where, *light, size});
    return Done{};
  }
  if (!(dot(*where, *where) > 0)) return unexpected("a direction other than 0,0,0", parts[1]);
  choice.around.push_back({*where, *light, size});
  return Done{};
}

LightRig rig_of(const LightChoice& choice, Vec3d ambient_light) {
  LightRig rig = choice.preset.value_or(LightRig{ambient_light, false, {}, {}});
  rig.lights.insert(rig.lights.end(), choice.around.begin(), choice.around.end());
  rig.placed.insert(rig.placed.end(), choice.placed.begin(), choice.placed.end());
  return rig;
}

}  // namespace bihive
