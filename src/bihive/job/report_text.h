// JSON as every report of the program is written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bihive {

/// ASCII, broken UTF-8 replaced. An indent below 0 makes one line.
std::string as_text(const nlohmann::ordered_json& json, int indent);

/// UTF-8 as PNG's plain text, which knows Latin-1 only; other letters become question marks.
std::string latin1(const std::string& text);

}  // namespace bihive
