// From text to a JSON document that the published schema (docs/scene.schema.json) accepts, or to an error that a person
// understands.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// The document. An error has line and column of what is no JSON (columns count bytes); a key that occurs twice in one
/// object is one too. `name` is the file's name for the message.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& name);

/// Done if scene_schema() accepts the document. Otherwise the first place, in the order of keys, that it does not: the
/// JSON pointer of the place, what the schema's title expects there, and what was found.
Status check_against_schema(const nlohmann::json& document, const std::string& name);

}  // namespace bihive
