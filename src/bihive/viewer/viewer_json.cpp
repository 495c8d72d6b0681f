#include "bihive/viewer/viewer_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bihive/bih/tree.h"
#include "bihive/io/cell_options.h"
#include "bihive/scene/scene_json.h"
#include "bihive/settings/parameter_json.h"

namespace bihive {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// kUnlimited exceeds JavaScript's numbers.
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

  // A parameter of a picture.
  void take(const Parameter& parameter, Overrides& values) {
    const std::string key(parameter.id);
    const json* member = find(key.c_str());
    if (member == nullptr) return;
    const std::optional<SettingValue> value = value_from_json(parameter, *member);
    if (!value) return fail(key, expected_by(parameter), *member);
    values.set(parameter.id, *value);
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

  // A direction, or null.
  void take(const char* key, std::optional<Vec3d>& value) {
    const json* member = find(key);
    if (member == nullptr) return;
    if (member->is_null()) return value.reset();
    Vec3d direction{0, 0, 0};
    take(key, direction);
    if (!error_.message.empty()) return;
    if (direction == Vec3d{0, 0, 0}) return fail(key, "a direction, or null", *member);
    value = direction;
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

// The parameters of the picture. With the member `set`, the user's are those that it names, and no others; without it,
// all that are present are added to them.
void take_parameters(Members& members, Overrides& user, Error& error) {
  Overrides found;
  for (Parameter parameter : picture_parameters()) {
    if (parameter.id == "samples_per_pixel") parameter.most = kMostSamples;
    if (parameter.in_window) members.take(parameter, found);
  }
  std::vector<std::string> of_user;
  const bool says_which = members.find("set") != nullptr;
  members.take("set", of_user);
  if (!error.message.empty()) return;
  if (says_which)
    for (const Parameter& parameter : picture_parameters())
      if (parameter.in_window) user.reset(parameter.id);
  for (const auto& [parameter, value] : found.all())
    if (!says_which || std::find(of_user.begin(), of_user.end(), parameter->id) != of_user.end())
      user.set(parameter->id, *value);
}

void put_parameters(const LayeredSettings& picture, ordered_json& document) {
  ordered_json of_user = ordered_json::array();
  for (const Parameter& parameter : picture_parameters()) {
    if (!parameter.in_window) continue;
    document[std::string(parameter.id)] = value_to_json(parameter, picture.value(parameter));
    if (picture.user.has(parameter.id)) of_user.push_back(parameter.id);
  }
  document["set"] = of_user;
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
  document["max_prims"] = limit(settings.max_prims);
  document["max_depth"] = limit(settings.max_depth);
  put_parameters(settings.picture, document);
  document["focus_on"] = settings.focus_on;
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
  members.take("max_prims", settings.max_prims);
  members.take("max_depth", settings.max_depth);
  take_parameters(members, settings.picture.user, error);
  members.take("focus_on", settings.focus_on);
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
  document["floor"] = look.floor;
  document["floor_up"] = look.floor_up ? vector_json(*look.floor_up) : ordered_json();
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
  members.take("floor", look.floor);
  members.take("floor_up", look.floor_up);
  take_rows(members, look.rows, error);
  members.refuse_others();
  if (!error.message.empty()) return error;
  return look;
}

std::string parameters_to_json() {
  return describe_parameters().dump();
}

}  // namespace bihive
