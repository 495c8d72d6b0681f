#include "bihive/settings/parameter_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bihive/image/colour_text.h"
#include "bihive/settings/picture_report.h"

namespace bihive {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kSamples = "samples_per_pixel";
constexpr const char* kAutomatic = "auto";

// "fog.start" is the key "start" of the object "fog".
std::string object_of(std::string_view path) {
  const std::size_t dot = path.find('.');
  return std::string(dot == std::string_view::npos ? "" : path.substr(0, dot));
}
std::string key_of(std::string_view path) {
  return std::string(path.substr(path.find('.') + 1));
}

// The row that says whether the row's object is present.
const Parameter& presence_of(const Parameter& row) {
  return row.implies.empty() ? row : *parameter_named(row.implies);
}
bool is_there(const Parameter& row, const PictureSettings& settings) {
  const SettingValue value = presence_of(row).get(settings);
  if (const bool* const flag = std::get_if<bool>(&value)) return *flag;
  return std::get<double>(value) != 0;
}

// A switch whose members are an object: the object's presence states it.
bool is_switch_of_object(const Parameter& row) {
  if (row.kind != ParameterKind::flag) return false;
  for (const Parameter& part : picture_parameters())
    if (part.implies == row.id) return true;
  return false;
}

bool is_default(const Parameter& row, const PictureSettings& settings) {
  return row.get(settings) == row.get(PictureSettings());
}

// Whether a scene file states it.
bool is_written(const Parameter& row, const PictureSettings& settings) {
  if (row.path.empty() || is_switch_of_object(row)) return false;
  if (std::holds_alternative<std::monostate>(row.get(settings))) return false;
  if (!object_of(row.path).empty()) return is_there(row, settings);
  return row.version == 1 || !is_default(row, settings);
}

// With as few digits as give the same bits.
std::string text_of(const Parameter& row, const SettingValue& value) {
  // JSON keeps the sign of -0 only in a fraction.
  const auto text = [](double number) {
    return number == 0 && std::signbit(number) ? "-0.0" : fmt::format("{}", number);
  };
  if (const double* const number = std::get_if<double>(&value)) return text(*number);
  if (const Vec3d* const v = std::get_if<Vec3d>(&value))
    return fmt::format("[{}, {}, {}]", text(v->x), text(v->y), text(v->z));
  return value_to_json(row, value).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// The settings with a default object instead of the one that holds the row.
void make_anew(const Parameter& part, PictureSettings& settings) {
  const Parameter& presence = presence_of(part);
  presence.set(settings, presence.kind == ParameterKind::flag ? SettingValue(false) : SettingValue(0.0));
  part.set(settings, part.get(PictureSettings()));
}

}  // namespace

std::optional<SettingValue> value_from_json(const Parameter& parameter, const json& value) {
  SettingValue found;
  const bool is_number = value.is_number() && std::isfinite(value.get<double>());
  switch (parameter.kind) {
    case ParameterKind::flag:
      if (value.is_boolean()) found = value.get<bool>();
      break;
    case ParameterKind::whole:
      if (is_number && value.is_number_integer() && std::abs(value.get<double>()) < 9e15)
        found = value.get<std::int64_t>();
      break;
    case ParameterKind::number:
      if (is_number) found = value.get<double>();
      break;
    case ParameterKind::choice: {
      std::int64_t position = 0;
      for (const std::string& name : names_of(parameter)) {
        if (value.is_string() && value.get_ref<const std::string&>() == name) found = position;
        ++position;
      }
      break;
    }
    case ParameterKind::text:
      if (value.is_string()) found = value.get<std::string>();
      break;
    case ParameterKind::colour:
      if (value.is_string() && colour_from_text(value.get_ref<const std::string&>(), Transfer::none))
        found = value.get<std::string>();
      if (value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() && value[2].is_number())
        found = colour_from_json(value, Transfer::none);
  }
  const bool is_found = value.is_null() == std::holds_alternative<std::monostate>(found);
  if (!is_found || !fits(parameter, found)) return std::nullopt;
  return found;
}

ordered_json value_to_json(const Parameter& parameter, const SettingValue& value) {
  if (parameter.kind == ParameterKind::choice)
    return names_of(parameter).at(static_cast<std::size_t>(std::get<std::int64_t>(value)));
  struct Write {
    ordered_json operator()(std::monostate) const { return nullptr; }
    ordered_json operator()(Vec3d v) const { return {v.x, v.y, v.z}; }
    ordered_json operator()(bool flag) const { return flag; }
    ordered_json operator()(std::int64_t number) const { return number; }
    ordered_json operator()(double number) const { return number; }
    ordered_json operator()(const std::string& text) const { return text; }
  };
  return std::visit(Write{}, value);
}

Vec3d colour_from_json(const json& value, Transfer transfer) {
  if (value.is_array()) return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
  return *colour_from_text(value.get_ref<const std::string&>(), transfer);
}

void take_picture(const json& picture, PictureSettings& settings) {
  if (picture.contains(kSamples)) {
    const json& samples = picture.at(kSamples);
    settings.adaptive_samples = samples.is_string();
    if (samples.is_number()) settings.samples_per_pixel = samples.get<int>();
  }
  // An object replaces the one of the layer below.
  std::string made;
  for (const Parameter& row : picture_parameters()) {
    const std::string object = object_of(row.path);
    if (object.empty() || object == made || row.implies.empty() || !picture.contains(object)) continue;
    make_anew(row, settings);
    made = object;
  }
  // From the last row to the first: the transfer curve before colours, and members before their objects.
  const auto rows = picture_parameters();
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    const std::string object = object_of(row->path);
    if (row->path.empty() || (!object.empty() && !picture.contains(object))) continue;
    const json& holder = object.empty() ? picture : picture.at(object);
    const auto found = holder.find(key_of(row->path));
    if (found == holder.end() || found->is_object()) continue;
    if (row->kind == ParameterKind::colour)
      row->set(settings, colour_from_json(*found, settings.transfer));
    else if (const auto value = value_from_json(*row, *found))
      row->set(settings, *value);
  }
}

std::string newer_key(const json& picture, int version) {
  for (const Parameter& row : picture_parameters()) {
    const std::string object = object_of(row.path), key = object.empty() ? std::string(row.path) : object;
    if (row.version > version && !key.empty() && picture.contains(key)) return key;
  }
  if (version < 2 && picture.contains(kSamples) && picture.at(kSamples).is_string()) return kSamples;
  return "";
}

std::string picture_to_json(const PictureSettings& settings) {
  std::string text, open;
  for (const Parameter& row : picture_parameters()) {
    if (row.id == kSamples)
      text += fmt::format(
          ", \"{}\": {}", kSamples,
          settings.adaptive_samples ? fmt::format("\"{}\"", kAutomatic) : std::to_string(settings.samples_per_pixel));
    if (!is_written(row, settings)) continue;
    const SettingValue value = row.get(settings);
    const std::string object = object_of(row.path);
    if (object != open && !open.empty()) text += "}";
    if (object != open && !object.empty()) text += fmt::format(", \"{}\": {{", object);
    text += fmt::format("{}\"{}\": {}", text.ends_with('{') ? "" : ", ", key_of(row.path), text_of(row, value));
    open = object;
  }
  if (!open.empty()) text += "}";
  return "{" + text.substr(2) + "}";
}

int picture_version(const PictureSettings& settings) {
  int version = settings.adaptive_samples ? 2 : 1;
  for (const Parameter& row : picture_parameters())
    if (is_written(row, settings)) version = std::max(version, row.version);
  return version;
}

std::string picture_report(const PictureSettings& settings, const ReportedScene& scene) {
  ordered_json report = ordered_json::object();
  for (const Parameter& row : picture_parameters()) {
    if (row.id == kSamples)
      report[kSamples] =
          settings.adaptive_samples ? ordered_json(kAutomatic) : ordered_json(settings.samples_per_pixel);
    const SettingValue value = row.get(settings);
    if (row.report.empty() || std::holds_alternative<std::monostate>(value)) continue;
    if (row.needs == ParameterNeeds::soft_light && !scene.soft_light) continue;
    if (row.needs == ParameterNeeds::see_through && !scene.see_through) continue;
    const bool is_said = row.version == 1 || row.needs == ParameterNeeds::soft_light ||
                         (row.group == ParameterGroup::tone && settings.tone.any()) || !is_default(row, settings);
    if (row.implies.empty() ? !is_said : !is_there(row, settings)) continue;
    const std::string object = object_of(row.report);
    (object.empty() ? report : report[object])[key_of(row.report)] = value_to_json(row, value);
  }
  return report.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string overrides_to_json(const Overrides& overrides) {
  ordered_json object = ordered_json::object();
  for (const auto& [parameter, value] : overrides.all())
    object[std::string(parameter->id)] = value_to_json(*parameter, *value);
  return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

namespace {

void describe_control(const Parameter& row, ordered_json& object) {
  object["label"] = row.label;
  if (!row.long_label.empty()) object["long_label"] = row.long_label;
  object["place"] = row.place;
  if (row.kind == ParameterKind::choice) object["choice_labels"] = choice_labels_of(row);
  if (!row.empty_means.empty()) object["empty_means"] = row.empty_means;
  if (row.slider_least != row.slider_most) object["slider"] = {row.slider_least, row.slider_most, row.slider_step};
  if (!row.unit.empty()) object["unit"] = row.unit;
  if (!row.only_with.empty()) object["only_with"] = row.only_with;
  if (!row.replaced_by.empty()) object["replaced_by"] = row.replaced_by;
  if (!row.note.empty()) object["note"] = row.note;
}

}  // namespace

ordered_json describe_parameters() {
  static constexpr const char* kKinds[] = {"flag", "whole", "number", "choice", "text", "colour"};
  static constexpr const char* kGroups[] = {"picture", "light", "lines", "tone", "labels", "cell"};
  static constexpr const char* kNeeds[] = {"", "soft_light", "see_through", "orthographic"};
  ordered_json rows = ordered_json::array();
  for (const Parameter& row : picture_parameters()) {
    ordered_json object;
    object["id"] = row.id;
    object["kind"] = kKinds[static_cast<int>(row.kind)];
    object["expected"] = expected_by(row);
    if (row.kind == ParameterKind::whole || row.kind == ParameterKind::number) {
      object["least"] = row.least;
      object["most"] = row.most;
      if (row.above_least) object["above_least"] = true;
      if (row.or_zero) object["or_zero"] = true;
    }
    if (row.nullable) object["nullable"] = true;
    if (row.kind == ParameterKind::choice) object["names"] = names_of(row);
    object["default"] = value_to_json(row, row.get(PictureSettings()));
    if (!row.path.empty()) object["path"] = row.path;
    object["version"] = row.version;
    if (row.has_option) object["option"] = option_of(row);
    object["group"] = kGroups[static_cast<int>(row.group)];
    if (row.in_window) object["in_window"] = true;
    if (row.cpu_only) object["cpu_only"] = true;
    if (row.needs != ParameterNeeds::nothing) object["needs"] = kNeeds[static_cast<int>(row.needs)];
    if (!row.implies.empty()) object["implies"] = row.implies;
    if (!row.label.empty()) describe_control(row, object);
    static constexpr const char* kRanks[] = {"refused", "whole", "chunks"};
    object["ranks"] = kRanks[static_cast<int>(row.ranks)];
    object["help"] = row.help;
    if (!row.usual.empty()) object["usual"] = row.usual;
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace bihive
