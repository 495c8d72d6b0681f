// The part of JSON Schema that scene files need.
#include "bihive/scene/json_schema.h"

#include <gtest/gtest.h>

#include <string>

#include "bihive/base/json_text.h"
#include "bihive/scene/scene_file.h"

namespace bihive {
namespace {

using nlohmann::json;

bool accepts(const std::string& schema, const std::string& value) {
  const json document = json::parse(schema);
  return JsonSchema(document).accepts(json::parse(value), document);
}

TEST(JsonSchema, TypesAndEnumerations) {
  const std::pair<const char*, const char*> right[] = {{"number", "1"},     {"number", "1.5"},   {"integer", "-7"},
                                                       {"string", "\"a\""}, {"boolean", "true"}, {"array", "[]"},
                                                       {"object", "{}"}};
  for (const auto& [type, value] : right) {
    EXPECT_TRUE(accepts("{\"type\": \"" + std::string(type) + "\"}", value)) << type;
    for (const auto& [other, another] : right) {
      // A whole number is a number too.
      const bool is_both = std::string(other) == type ||
                           (std::string(type) == "number" && std::string(other) == "integer") ||
                           (std::string(type) == "integer" && std::string(another) == "1");
      EXPECT_EQ(accepts("{\"type\": \"" + std::string(type) + "\"}", another), is_both) << type << ' ' << another;
    }
    EXPECT_FALSE(accepts("{\"type\": \"" + std::string(type) + "\"}", "null")) << type;
  }
  EXPECT_FALSE(accepts(R"({"type": "integer"})", "1.0"));
  EXPECT_TRUE(accepts(R"({"enum": [1, "a"]})", "1"));
  EXPECT_TRUE(accepts(R"({"enum": [1, "a"]})", "\"a\""));
  EXPECT_FALSE(accepts(R"({"enum": [1, "a"]})", "2"));
  EXPECT_FALSE(accepts(R"({"enum": [1, "a"]})", "\"1\""));
}

TEST(JsonSchema, Limits) {
  EXPECT_TRUE(accepts(R"({"minimum": 1, "maximum": 2})", "1"));
  EXPECT_TRUE(accepts(R"({"minimum": 1, "maximum": 2})", "2"));
  EXPECT_FALSE(accepts(R"({"minimum": 1, "maximum": 2})", "0.99"));
  EXPECT_FALSE(accepts(R"({"minimum": 1, "maximum": 2})", "2.01"));
  EXPECT_TRUE(accepts(R"({"minimum": 1})", "\"no number\""));
  EXPECT_FALSE(accepts(R"({"exclusiveMinimum": 1})", "1"));
  EXPECT_TRUE(accepts(R"({"exclusiveMinimum": 1})", "1.001"));
  EXPECT_FALSE(accepts(R"({"exclusiveMaximum": 1})", "1"));
  EXPECT_TRUE(accepts(R"({"exclusiveMaximum": 1})", "0.999"));
  EXPECT_TRUE(accepts(R"({"minLength": 2})", "\"\u00e4\u00f6\""));
  EXPECT_FALSE(accepts(R"({"minLength": 2})", "\"\u00e4\"")) << "letters, not bytes";
  EXPECT_TRUE(accepts(R"({"minItems": 1, "maxItems": 2})", "[1, 2]"));
  EXPECT_FALSE(accepts(R"({"minItems": 1, "maxItems": 2})", "[]"));
  EXPECT_FALSE(accepts(R"({"minItems": 1, "maxItems": 2})", "[1, 2, 3]"));
  EXPECT_TRUE(accepts(R"({"minProperties": 1, "maxProperties": 1})", R"({"a": 1})"));
  EXPECT_FALSE(accepts(R"({"minProperties": 1, "maxProperties": 1})", "{}"));
  EXPECT_FALSE(accepts(R"({"minProperties": 1, "maxProperties": 1})", R"({"a": 1, "b": 1})"));
}

TEST(JsonSchema, ArraysAndObjects) {
  EXPECT_TRUE(accepts(R"({"items": {"type": "number"}})", "[1, 2]"));
  EXPECT_FALSE(accepts(R"({"items": {"type": "number"}})", "[1, \"a\"]"));
  const std::string tuple = R"({"items": [{"type": "number"}, {"type": "string"}], "additionalItems": false})";
  EXPECT_TRUE(accepts(tuple, "[1, \"a\"]"));
  EXPECT_TRUE(accepts(tuple, "[1]"));
  EXPECT_FALSE(accepts(tuple, "[1, 2]"));
  EXPECT_FALSE(accepts(tuple, "[1, \"a\", 1]"));
  EXPECT_TRUE(accepts(R"({"items": [{"type": "number"}]})", "[1, \"a\"]"));
  const std::string object =
      R"({"required": ["a"], "properties": {"a": {"type": "number"}, "b": {}}, "additionalProperties": false})";
  EXPECT_TRUE(accepts(object, R"({"a": 1, "b": "x"})"));
  EXPECT_FALSE(accepts(object, R"({"b": 1})"));
  EXPECT_FALSE(accepts(object, R"({"a": "x"})"));
  EXPECT_FALSE(accepts(object, R"({"a": 1, "c": 1})"));
  EXPECT_TRUE(accepts(object, "7")) << "no object";
  EXPECT_FALSE(accepts(R"({"additionalProperties": {"type": "string"}})", R"({"a": 1})"));
  EXPECT_TRUE(accepts(R"({"additionalProperties": {"type": "string"}})", R"({"a": "1"})"));
}

TEST(JsonSchema, AlternativesAndReferences) {
  EXPECT_TRUE(accepts(R"({"anyOf": [{"type": "number"}, {"enum": ["none"]}]})", "\"none\""));
  EXPECT_FALSE(accepts(R"({"anyOf": [{"type": "number"}, {"enum": ["none"]}]})", "\"some\""));
  const std::string schema =
      R"({"properties": {"a": {"$ref": "#/definitions/x", "type": "string"}}, "definitions": {"x": {"$ref": "#/definitions/y"}, "y": {"type": "number"}}})";
  EXPECT_TRUE(accepts(schema, R"({"a": 1})")) << "beside $ref nothing counts";
  EXPECT_FALSE(accepts(schema, R"({"a": "1"})"));
}

TEST(JsonSchema, PatternsAreAlternatives) {
  const std::string colour = R"(^(#[0-9a-fA-F]{6}|srgb\([0-9.e+-]+,[0-9]+\)|red)$)";
  for (const char* const right : {"#00aAfF", "srgb(1.5e-3,7)", "red"})
    EXPECT_TRUE(matches_alternatives(colour, right)) << right;
  for (const char* const wrong :
       {"", "#00aAf", "#00aAfFF", "#00aAfG", "srgb(,7)", "srgb(1,7", "srgb(1,7.5)", "re", "redd", "Red", "red|", "|"})
    EXPECT_FALSE(matches_alternatives(colour, wrong)) << wrong;
}

// Every schema in the document, each at least once.
void visit(const JsonSchema& root, const json& schema, int& count) {
  ++count;
  // A keyword or pattern that is not known ends the test.
  for (const char* const value :
       {"1", "0.5", "\"red\"", "[]", "[1, 2, 3, 4, 5]", "{}", "{\"no such key\": 1}", "true", "null"})
    root.accepts(json::parse(value), schema);
  for (const auto& [keyword, part] : schema.items()) {
    if (keyword == "items" && part.is_array())
      for (const json& one : part) visit(root, one, count);
    if (keyword == "anyOf")
      for (const json& one : part) visit(root, one, count);
    if ((keyword == "items" || keyword == "additionalProperties") && part.is_object()) visit(root, part, count);
    if (keyword == "properties" || keyword == "definitions")
      for (const auto& named : part.items()) visit(root, named.value(), count);
  }
}

TEST(JsonSchema, ThePublishedSchemaKeepsToWhatIsKnown) {
  const Result<json> schema = json_from_text<json>(scene_schema());
  ASSERT_TRUE(schema.ok());
  int count = 0;
  visit(JsonSchema(*schema), *schema, count);
  EXPECT_GT(count, 200);
}

}  // namespace
}  // namespace bihive
