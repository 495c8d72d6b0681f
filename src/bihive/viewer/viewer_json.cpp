#include "bihive/viewer/viewer_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bihive/bih/tree.h"
#include "bihive/io/cell_options.h"
#include "bihive/scene/light_points.h"
#include "bihive/scene/scene_json.h"

namespace bihive {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// kUnlimited is more than JavaScript's numbers hold.
constexpr const char* kUnlimitedName = "unlimited";

// Takes members out of one object, and remembers the first fault.
class Members {
 public:
  Members(const json& object, std::string place, Error& error)
      : object_(object), place_(std::move(place)), error_(error) {
    if (!object.is_object()) fail("", "an object", object);
  }

  // The member `key`; null if it is missing or a fault was found before.
  const json* find(const char* key) {
    known_.emplace_back(key);
    if (!error_.message.empty()) return nullptr;
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }

  void take(const char* key, bool& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!member->is_boolean()) return fail(key, "true or false", *member);
    value = member->get<bool>();
  }

  void take(const char* key, int& value, int min, int max) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!is_integer(*member, min, max))
      return fail(key, "a whole number from " + std::to_string(min) + " to " + std::to_string(max), *member);
    value = member->get<int>();
  }

  void take(const char* key, std::optional<std::int64_t>& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (member->is_null()) return value.reset();
    if (*member == kUnlimitedName) {
      value = kUnlimited;
      return;
    }
    if (!is_integer(*member, 1, kUnlimited)) return fail(key, "a whole number from 1, \"unlimited\" or null", *member);
    value = member->get<std::int64_t>();
  }

  void take(const char* key, std::optional<std::array<std::int32_t, 3>>& value, std::int32_t min, std::int32_t max) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (member->is_null()) return value.reset();
    bool fits = member->is_array() && member->size() == 3;
    for (std::size_t i = 0; fits && i < 3; ++i) fits = is_integer(member->at(i), min, max);
    if (!fits)
      return fail(key, "three whole numbers from " + std::to_string(min) + " to " + std::to_string(max) + ", or null",
                  *member);
    value = member->get<std::array<std::int32_t, 3>>();
  }

  void take(const char* key, double& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!is_finite_number(*member)) return fail(key, "a number", *member);
    value = member->get<double>();
  }

  void take(const char* key, double& value, double min, double max) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!is_finite_number(*member) || !(member->get<double>() >= min && member->get<double>() <= max))
      return fail(key, "a number from " + json(min).dump() + " to " + json(max).dump(), *member);
    value = member->get<double>();
  }

  void take(const char* key, std::vector<std::string>& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    std::vector<std::string> texts;
    if (!member->is_array()) return fail(key, "a list of texts", *member);
    for (const json& text : *member) {
      if (!text.is_string()) return fail(key, "a list of texts", *member);
      texts.push_back(text.get<std::string>());
    }
    value = std::move(texts);
  }

  // null: none.
  void take(const char* key, std::optional<std::string>& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (member->is_null()) return value.reset();
    if (!member->is_string()) return fail(key, "a text or null", *member);
    value = member->get<std::string>();
  }

  // null: without a limit.
  void take_distance(const char* key, double& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!member->is_null() && !(is_finite_number(*member) && member->get<double>() > 0))
      return fail(key, "a number above 0, or null", *member);
    value = member->is_null() ? std::numeric_limits<double>::infinity() : member->get<double>();
  }

  void take(const char* key, std::string& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!member->is_string()) return fail(key, "a text", *member);
    value = member->get<std::string>();
  }

  void take(const char* key, Vec3d& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (!member->is_array() || member->size() != 3) return fail(key, "three numbers", *member);
    for (int axis = 0; axis < 3; ++axis) {
      const json& number = member->at(static_cast<std::size_t>(axis));
      if (!is_finite_number(number)) return fail(key, "three numbers", *member);
      value[axis] = number.get<double>();
    }
  }

  template <class T>
  void take(const char* key, T& value, const Names<T>& names) {
    const json* member = find(key);
    if (member == nullptr) return;
    std::string list;
    for (const auto& [name, named] : names) {
      if (member->is_string() && member->get_ref<const std::string&>() == name) {
        value = named;
        return;
      }
      list += (list.empty() ? "" : ", ") + name;
    }
    fail(key, "one of " + list, *member);
  }

  /// Call it after all members are taken.
  void refuse_others() {
    if (!error_.message.empty()) return;
    for (const auto& [key, member] : object_.items()) {
      bool known = false;
      for (const std::string& name : known_) known = known || name == key;
      if (known) continue;
      std::string list;
      for (const std::string& name : known_) list += (list.empty() ? "" : ", ") + name;
      error_ = {place_ + "/" + shown(json(key)) + ": unknown key", "", 0, 0, "there are " + list};
      return;
    }
  }

 private:
  static bool is_integer(const json& value, std::int64_t min, std::int64_t max) {
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(max)) return false;
    return value.is_number_integer() && value.get<std::int64_t>() >= min && value.get<std::int64_t>() <= max;
  }
  static bool is_finite_number(const json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

  static std::string shown(const json& value) {
    constexpr std::size_t kLongest = 60;
    std::string text = value.dump(-1, ' ', /*ensure_ascii=*/true, json::error_handler_t::replace);
    if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
    return text;
  }

  void fail(const std::string& key, const std::string& expected, const json& found) {
    const std::string place = place_ + (key.empty() ? "" : "/" + key);
    error_ = {(place.empty() ? "" : place + ": ") + "expected " + expected + ", found " + shown(found), "", 0, 0, ""};
  }

  const json& object_;
  std::string place_;
  Error& error_;
  std::vector<std::string> known_;
};

// The rows of a look.
void take_rows(Members& members, std::vector<LookRow>& rows, Error& error) {
  const json* const list = members.find("rows");
  if (list == nullptr) return;
  rows.clear();
  if (!list->is_array()) {
    error = {"/rows: expected an array", "", 0, 0, ""};
    return;
  }
  for (const json& value : *list) {
    LookRow row;
    Members of_row(value, "/rows/" + std::to_string(rows.size()), error);
    of_row.take("select", row.select);
    of_row.take("action", row.action);
    of_row.take("value", row.value);
    of_row.refuse_others();
    if (!error.message.empty()) return;
    rows.push_back(std::move(row));
  }
}

void take_effects(Members& members, ViewerEffects& effects) {
  members.take("samples_auto", effects.adaptive_samples);
  members.take("ao", effects.ambient_occlusion);
  members.take_distance("ao_distance", effects.ambient_distance);
  members.take("ao_directions", effects.ambient_directions, 1, kMostAmbientDirections);
  members.take("light_points", effects.light_points, 1, kMostLightPoints);
  members.take("opacity_rule", effects.opacity_rule, kOpacityRules);
  members.take("fog", effects.fog, 0, 1);
  members.take("outline_px", effects.outline_px, 0, kWidestOutlinePx);
  members.take("exposure", effects.tone.exposure_stops, -kMostExposureStops, kMostExposureStops);
  members.take("tone", effects.tone.curve, kToneCurves);
  members.take("legend", effects.labels.legend);
  members.take("scale_bar", effects.labels.scale_bar);
  members.take("axes", effects.labels.axes);
  members.take("title", effects.labels.title);
  members.take("length_unit", effects.labels.length_unit);
}

void put_effects_json(const ViewerEffects& effects, ordered_json& document) {
  const Labels& labels = effects.labels;
  const bool limited = std::isfinite(effects.ambient_distance);
  document["samples_auto"] = effects.adaptive_samples;
  document["ao"] = effects.ambient_occlusion;
  document["ao_distance"] = limited ? ordered_json(effects.ambient_distance) : ordered_json();
  document["ao_directions"] = effects.ambient_directions;
  document["light_points"] = effects.light_points;
  document["opacity_rule"] = name_of(kOpacityRules, effects.opacity_rule);
  document["fog"] = effects.fog;
  document["outline_px"] = effects.outline_px;
  document["exposure"] = effects.tone.exposure_stops;
  document["tone"] = name_of(kToneCurves, effects.tone.curve);
  document["legend"] = labels.legend;
  document["scale_bar"] = labels.scale_bar;
  document["axes"] = labels.axes;
  document["title"] = labels.title;
  document["length_unit"] = labels.length_unit ? ordered_json(*labels.length_unit) : ordered_json();
}

ordered_json vector_json(Vec3d v) {
  return {v.x, v.y, v.z};
}

}  // namespace

std::string settings_to_json(const ViewerSettings& settings) {
  const auto limit = [](const std::optional<std::int64_t>& value) {
    if (!value) return ordered_json();
    return *value == kUnlimited ? ordered_json(kUnlimitedName) : ordered_json(*value);
  };
  ordered_json document;
  document["engine"] = name_of(kViewerEngines, settings.engine);
  document["view"] = name_of(kViews, settings.view);
  document["recursion"] = settings.recursion;
  document["samples_per_pixel"] = settings.samples_per_pixel;
  document["shadows"] = settings.shadows;
  document["max_prims"] = limit(settings.max_prims);
  document["max_depth"] = limit(settings.max_depth);
  put_effects_json(settings.effects, document);
  document["focus_on"] = settings.focus_on;
  document["cell"] = settings.cell;
  document["replicate"] = settings.replicate ? ordered_json(*settings.replicate) : ordered_json();
  document["camera"] = {{"eye", vector_json(settings.camera.eye)},
                        {"look_at", vector_json(settings.camera.look_at)},
                        {"up", vector_json(settings.camera.up)},
                        {"fov_deg", settings.camera.fov_deg},
                        {"projection", name_of(kProjections, settings.camera.projection)},
                        {"shorter_side", settings.camera.shorter_side},
                        {"aperture", settings.camera.aperture},
                        {"focus", settings.camera.focus}};
  return document.dump(-1, ' ', /*ensure_ascii=*/true, ordered_json::error_handler_t::replace);
}

Result<ViewerSettings> settings_from_json(std::string_view text, const ViewerSettings& base) {
  const Result<json> document = parse_json(text, "settings");
  if (!document) return document.error();
  ViewerSettings settings = base;
  Error error;
  Members members(*document, "", error);
  members.take("engine", settings.engine, kViewerEngines);
  members.take("view", settings.view, kViews);
  members.take("recursion", settings.recursion, 1, kMostRecursion);
  members.take("samples_per_pixel", settings.samples_per_pixel, 1, kMostSamples);
  members.take("shadows", settings.shadows);
  members.take("max_prims", settings.max_prims);
  members.take("max_depth", settings.max_depth);
  take_effects(members, settings.effects);
  members.take("focus_on", settings.focus_on);
  members.take("cell", settings.cell);
  members.take("replicate", settings.replicate, 1, kMostCopies);
  if (const json* camera = members.find("camera")) {
    Members of_camera(*camera, "/camera", error);
    of_camera.take("eye", settings.camera.eye);
    of_camera.take("look_at", settings.camera.look_at);
    of_camera.take("up", settings.camera.up);
    of_camera.take("fov_deg", settings.camera.fov_deg);
    Projection projection = settings.camera.projection;
    of_camera.take("projection", projection, kProjections);
    if (camera->is_object() && camera->contains("shorter_side"))
      settings.camera.projection = projection;
    else
      settings.camera = with_projection(settings.camera, projection);
    of_camera.take("shorter_side", settings.camera.shorter_side);
    of_camera.take("aperture", settings.camera.aperture);
    of_camera.take("focus", settings.camera.focus);
    of_camera.refuse_others();
  }
  members.refuse_others();
  if (!error.message.empty()) return error;
  return settings;
}

std::string viewer_look_to_json(const ViewerLook& look) {
  ordered_json document;
  document["style"] = look.style;
  document["element_colours"] = look.element_colours;
  document["background"] = look.background;
  document["lights"] = look.lights;
  document["colour_by"] = look.colour_by;
  document["nan_colour"] = look.nan_colour;
  document["crease"] = look.crease;
  document["rows"] = ordered_json::array();
  for (const LookRow& row : look.rows)
    document["rows"].push_back({{"select", row.select}, {"action", row.action}, {"value", row.value}});
  return document.dump(-1, ' ', /*ensure_ascii=*/true, ordered_json::error_handler_t::replace);
}

Result<ViewerLook> viewer_look_from_json(std::string_view text, const ViewerLook& base) {
  const Result<json> document = parse_json(text, "look");
  if (!document) return document.error();
  ViewerLook look = base;
  Error error;
  Members members(*document, "", error);
  members.take("style", look.style);
  members.take("element_colours", look.element_colours);
  members.take("background", look.background);
  members.take("lights", look.lights);
  members.take("colour_by", look.colour_by);
  members.take("nan_colour", look.nan_colour);
  members.take("crease", look.crease);
  take_rows(members, look.rows, error);
  members.refuse_others();
  if (!error.message.empty()) return error;
  return look;
}

}  // namespace bihive
