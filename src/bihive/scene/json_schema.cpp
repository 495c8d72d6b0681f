#include "bihive/scene/json_schema.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "bihive/base/check.h"

namespace bihive {
namespace {

using nlohmann::json;

std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80; }));
}

// A limit of the keyword's kind; true where it does not concern the value.
bool keeps_limit(const json& value, const std::string& keyword, const json& limit) {
  if (keyword == "minLength")
    return !value.is_string() || letters_of(value.get_ref<const std::string&>()) >= limit.get<std::size_t>();
  if (keyword == "minItems") return !value.is_array() || value.size() >= limit.get<std::size_t>();
  if (keyword == "maxItems") return !value.is_array() || value.size() <= limit.get<std::size_t>();
  if (keyword == "minProperties") return !value.is_object() || value.size() >= limit.get<std::size_t>();
  if (keyword == "maxProperties") return !value.is_object() || value.size() <= limit.get<std::size_t>();
  if (!value.is_number()) return true;
  const double number = value.get<double>(), end = limit.get<double>();
  if (keyword == "minimum") return number >= end;
  if (keyword == "maximum") return number <= end;
  if (keyword == "exclusiveMinimum") return number > end;
  BIHIVE_CHECK(keyword == "exclusiveMaximum");
  return number < end;
}

bool says_nothing_of_values(const std::string& keyword) {
  for (const char* const one : {"title", "description", "default", "definitions", "$schema"})
    if (keyword == one) return true;
  return false;
}

// Takes the class at the front of a pattern, with its brackets, or one character, which a backslash may be before.
std::string_view take_class(std::string_view& pattern) {
  const std::size_t length = pattern[0] == '[' ? pattern.find(']') + 1 : pattern[0] == '\\' ? 2 : 1;
  const std::string_view taken = pattern.substr(0, length);
  pattern.remove_prefix(length);
  return taken;
}

bool is_in(std::string_view of, char c) {
  if (of[0] != '[') return c == of.back();
  of = of.substr(1, of.size() - 2);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const bool is_range = i + 2 < of.size() && of[i + 1] == '-';
    if (is_range ? c >= of[i] && c <= of[i + 2] : c == of[i]) return true;
    if (is_range) i += 2;
  }
  return false;
}

bool matches_all(std::string_view pattern, std::string_view text) {
  while (!pattern.empty()) {
    const std::string_view of = take_class(pattern);
    std::size_t least = 1, most = 1;
    if (pattern.substr(0, 1) == "+") {
      most = text.size();
      pattern.remove_prefix(1);
    } else if (pattern.substr(0, 1) == "{") {
      const std::size_t close = pattern.find('}');
      BIHIVE_CHECK(close == 2);
      least = most = static_cast<std::size_t>(pattern[1] - '0');
      pattern.remove_prefix(close + 1);
    }
    std::size_t count = 0;
    while (count < most && count < text.size() && is_in(of, text[count])) ++count;
    if (count < least) return false;
    text.remove_prefix(count);
  }
  return text.empty();
}

}  // namespace

bool has_json_type(const json& value, std::string_view type) {
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  return type == "object" && value.is_object();
}

bool matches_alternatives(std::string_view pattern, std::string_view text) {
  BIHIVE_CHECK(pattern.size() >= 4 && pattern.substr(0, 2) == "^(" && pattern.substr(pattern.size() - 2) == ")$");
  pattern = pattern.substr(2, pattern.size() - 4);
  for (;;) {
    std::string_view rest = pattern;
    while (!rest.empty() && rest[0] != '|') take_class(rest);
    const std::size_t length = pattern.size() - rest.size();
    if (matches_all(pattern.substr(0, length), text)) return true;
    if (rest.empty()) return false;
    pattern = rest.substr(1);
  }
}

const json& JsonSchema::resolved(const json& schema) const {
  const json* at = &schema;
  while (at->is_object() && at->contains("$ref"))
    at = &document_.at(json::json_pointer(at->at("$ref").get_ref<const std::string&>().substr(1)));
  return *at;
}

bool JsonSchema::accepts(const json& value, const json& unresolved) const {
  const json& schema = resolved(unresolved);
  if (schema.is_boolean()) return schema.get<bool>();
  for (const auto& [keyword, wanted] : schema.items()) {
    bool accepted = true;
    if (keyword == "type") {
      accepted = has_json_type(value, wanted.get_ref<const std::string&>());
    } else if (keyword == "enum") {
      accepted = std::find(wanted.begin(), wanted.end(), value) != wanted.end();
    } else if (keyword == "pattern") {
      accepted = !value.is_string() ||
                 matches_alternatives(wanted.get_ref<const std::string&>(), value.get_ref<const std::string&>());
    } else if (keyword == "anyOf") {
      accepted = std::any_of(wanted.begin(), wanted.end(), [&](const json& one) { return accepts(value, one); });
    } else if (keyword == "items") {
      accepted = !value.is_array() || accepts_items(value, schema);
    } else if (keyword == "required") {
      accepted = !value.is_object() || std::all_of(wanted.begin(), wanted.end(), [&](const json& key) {
        return value.contains(key.get_ref<const std::string&>());
      });
    } else if (keyword == "properties") {
      for (const auto& [key, of_key] : wanted.items())
        if (const auto member = value.is_object() ? value.find(key) : value.end(); member != value.end())
          accepted = accepted && accepts(*member, of_key);
    } else if (keyword == "additionalProperties") {
      accepted = !value.is_object() || accepts_members(value, schema);
    } else if (keyword != "additionalItems" && !says_nothing_of_values(keyword)) {
      accepted = keeps_limit(value, keyword, wanted);
    }
    if (!accepted) return false;
  }
  return true;
}

bool JsonSchema::accepts_items(const json& array, const json& schema) const {
  const json& items = schema.at("items");
  if (!items.is_array())
    return std::all_of(array.begin(), array.end(), [&](const json& item) { return accepts(item, items); });
  const auto others = schema.find("additionalItems");
  for (std::size_t i = 0; i < array.size(); ++i)
    if (i < items.size() ? !accepts(array[i], items[i]) : others != schema.end() && !accepts(array[i], *others))
      return false;
  return true;
}

// Those that `properties` does not name.
bool JsonSchema::accepts_members(const json& object, const json& schema) const {
  const json& others = schema.at("additionalProperties");
  const auto named = schema.find("properties");
  for (const auto& [key, member] : object.items())
    if ((named == schema.end() || !named->contains(key)) && !accepts(member, others)) return false;
  return true;
}

}  // namespace bihive
