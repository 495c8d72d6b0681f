// JSON as every report of the program is written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bihive::cli {

/// ASCII, broken UTF-8 replaced. An indent below 0 makes one line.
std::string as_text(const nlohmann::ordered_json& json, int indent);

}  // namespace bihive::cli
