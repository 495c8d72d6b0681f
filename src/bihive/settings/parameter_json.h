// Parameters as JSON: in scene and style files, in the state of window and page, in reports, and the table itself.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "bihive/settings/overrides.h"
#include "bihive/settings/parameter.h"

namespace bihive {

/// Nothing: the value has another kind, or is out of range.
std::optional<SettingValue> value_from_json(const Parameter& parameter, const nlohmann::json& value);
nlohmann::ordered_json value_to_json(const Parameter& parameter, const SettingValue& value);

/// Reads a colour from JSON's array or text.
Vec3d colour_from_json(const nlohmann::json& value, Transfer transfer);

/// `picture` of a scene or style file that the schema accepts. Missing keys keep their values.
void take_picture(const nlohmann::json& picture, PictureSettings& settings);

/// The first key of `picture` that a later version of the format introduced; empty: none.
std::string newer_key(const nlohmann::json& picture, int version);

/// The text of `picture` for a scene file: the keys of every version of the format, and those that differ from the
/// defaults.
std::string picture_to_json(const PictureSettings& settings);

/// The oldest version of the format that has all of that.
int picture_version(const PictureSettings& settings);

/// The table, for code generated from it in other languages.
nlohmann::ordered_json describe_parameters();

}  // namespace bihive
