#include "bihive/settings/overrides.h"

#include <algorithm>

#include "bihive/base/check.h"
#include "bihive/image/colour_text.h"

namespace bihive {
namespace {

const Parameter* known(std::string_view id) {
  const Parameter* const parameter = parameter_named(id);
  BIHIVE_CHECK(parameter != nullptr);
  return parameter;
}

}  // namespace

void Overrides::set(std::string_view id, SettingValue value) {
  const Parameter* const parameter = known(id);
  if (const auto* const whole = std::get_if<std::int64_t>(&value);
      whole != nullptr && parameter->kind == ParameterKind::number)
    value = static_cast<double>(*whole);
  BIHIVE_CHECK(fits(*parameter, value));
  const auto at = std::lower_bound(values_.begin(), values_.end(), parameter,
                                   [](const auto& entry, const Parameter* wanted) { return entry.first < wanted; });
  if (at != values_.end() && at->first == parameter)
    at->second = std::move(value);
  else
    values_.emplace(at, parameter, std::move(value));
}

void Overrides::reset(std::string_view id) {
  const Parameter* const parameter = known(id);
  std::erase_if(values_, [parameter](const auto& entry) { return entry.first == parameter; });
}

const SettingValue* Overrides::find(std::string_view id) const {
  const Parameter* const parameter = known(id);
  for (const auto& [row, value] : values_)
    if (row == parameter) return &value;
  return nullptr;
}

bool Overrides::is_on(std::string_view id) const {
  const SettingValue* const value = find(id);
  return value != nullptr && std::get<bool>(*value);
}

std::vector<std::pair<const Parameter*, const SettingValue*>> Overrides::all() const {
  std::vector<std::pair<const Parameter*, const SettingValue*>> entries;
  for (const auto& [row, value] : values_) entries.emplace_back(row, &value);
  return entries;
}

void Overrides::apply_to(PictureSettings& settings) const {
  // The transfer curve is last in the table, so first here; a row that implies another comes before it.
  for (auto entry = values_.rbegin(); entry != values_.rend(); ++entry) {
    const auto& [parameter, value] = *entry;
    const auto* const text = std::get_if<std::string>(&value);
    if (parameter->kind == ParameterKind::colour && text != nullptr)
      parameter->set(settings, *colour_from_text(*text, settings.transfer));
    else
      parameter->set(settings, value);
  }
}

bool leaves_out_fog(const PictureSettings& picture, const Overrides& user, bool scene_states_fog) {
  return picture.labels.legend && !scene_states_fog && !user.has("fog") && !user.has("fog_start") &&
         !user.has("fog_end");
}

PictureSettings LayeredSettings::result() const {
  PictureSettings settings = below;
  user.apply_to(settings);
  return settings;
}

SettingValue LayeredSettings::value(const Parameter& parameter) const {
  const SettingValue* const of_user = user.find(parameter.id);
  if (of_user != nullptr) return *of_user;
  return parameter.get(parameter.implies.empty() ? result() : below);
}

}  // namespace bihive
