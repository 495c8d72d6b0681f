// One entry of the key `looks` of a scene file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bihive/scene/looks.h"

namespace bihive {

/// The schema has accepted the value.
Look look_from_json(const nlohmann::json& value);

}  // namespace bihive
