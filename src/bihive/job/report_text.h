// JSON in the format of every report of the program.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bihive {

/// ASCII, broken UTF-8 replaced. An indent below 0 makes one line.
std::string as_text(const nlohmann::ordered_json& json, int indent);

/// Converts UTF-8 to PNG's plain text, which is Latin-1; other letters become question marks.
std::string latin1(const std::string& text);

}  // namespace bihive
