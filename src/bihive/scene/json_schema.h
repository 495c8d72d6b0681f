// JSON Schema, draft 7, as far as docs/scene.schema.json uses it.
//
// Knows type, enum, the limits of numbers, texts, arrays and objects, pattern, items (a schema, or one for each place),
// additionalItems, properties, additionalProperties, required, anyOf and $ref to "#/...", beside which other keywords
// do not count. tests/unit/json_schema_test.cpp looks whether the published schema keeps to these.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace bihive {

class JsonSchema {
 public:
  /// The document that "#/..." means; it must outlive this.
  explicit JsonSchema(const nlohmann::json& document) : document_(document) {}

  /// Follows "$ref".
  const nlohmann::json& resolved(const nlohmann::json& schema) const;
  /// Whether the value is one that this part of the document describes. A keyword that is not known is a programmer's
  /// error.
  bool accepts(const nlohmann::json& value, const nlohmann::json& schema) const;

 private:
  bool accepts_items(const nlohmann::json& array, const nlohmann::json& schema) const;
  bool accepts_members(const nlohmann::json& object, const nlohmann::json& schema) const;

  const nlohmann::json& document_;
};

/// Whether a value has a type of JSON Schema. A number with a decimal point is no "integer".
bool has_json_type(const nlohmann::json& value, std::string_view type);

/// Whether the text is one of the alternatives of "^(one|other)$": characters, classes such as [0-9a-f], and "+" or
/// "{6}" after a class. What follows a class with "+" must not be in it. Other patterns are a programmer's error.
bool matches_alternatives(std::string_view pattern, std::string_view text);

}  // namespace bihive
