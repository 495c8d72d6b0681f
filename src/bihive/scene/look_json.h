// One entry of the key `looks` of a scene file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bihive/scene/looks.h"

namespace bihive {

/// All: the schema has accepted the value.
ColourBy colour_by_from_json(const nlohmann::json& value);
Clip clip_from_json(const nlohmann::json& value);
Look look_from_json(const nlohmann::json& value);

}  // namespace bihive
