// Parameters as JSON: in scene and style files, in the state of window and page, in reports, and the table itself.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "bihive/settings/overrides.h"
#include "bihive/settings/parameter.h"

namespace bihive {

/// Nothing: the value is not of the parameter's kind, or out of its range.
std::optional<SettingValue> value_from_json(const Parameter& parameter, const nlohmann::json& value);
nlohmann::ordered_json value_to_json(const Parameter& parameter, const SettingValue& value);

/// From JSON's array or text of a colour.
Vec3d colour_from_json(const nlohmann::json& value, Transfer transfer);

/// `picture` of a scene or style file that the schema accepts. What the object does not say keeps its value.
void take_picture(const nlohmann::json& picture, PictureSettings& settings);

/// The first key of `picture` that came with a later version of the format; empty: none.
std::string newer_key(const nlohmann::json& picture, int version);

/// The text of `picture` for a scene file: what every version of the format has, and what differs from the defaults.
std::string picture_to_json(const PictureSettings& settings);

/// The oldest version of the format that has all of that.
int picture_version(const PictureSettings& settings);

/// The table, for what is generated from it in other languages.
nlohmann::ordered_json describe_parameters();

}  // namespace bihive
