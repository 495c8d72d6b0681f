// Parses text into a JSON document that the published schema (docs/scene.schema.json) accepts, or a readable error.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// The document. An error has line and column of the text that is not JSON (columns count bytes). A key that occurs
/// twice in one object is an error too. `name` is the file's name for the message.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& name);

/// Success if scene_schema() accepts the document. Otherwise an error for the first refused value, in the order of
/// keys: its JSON pointer, the expected value by the schema's title, and the value found.
Status check_against_schema(const nlohmann::json& document, const std::string& name);

/// The same for one of the schema's definitions.
Status check_against_definition(const nlohmann::json& document, const std::string& definition, const std::string& name);

}  // namespace bihive
