#include "bihive/scene/scene_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "bihive/base/json_text.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/scene/json_schema.h"
#include "bihive/scene/scene_file.h"

namespace bihive {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestQuote = 60;  // bytes of the user's text that a message repeats

std::string shortened(std::string text) {
  if (text.size() <= kLongestQuote) return text;
  std::size_t end = kLongestQuote;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // never cut a UTF-8 character
  return text.substr(0, end) + "...";
}

std::string in_quotes(const std::string& text) {
  return printable(shortened(json(text).dump(-1, ' ', false, json::error_handler_t::replace)));
}

// --- Syntax -----------------------------------------------------------------------------------------------------

// Parses a document without keeping it; finds the offset where it stops being JSON, and duplicate keys.
class SyntaxCheck : public json::json_sax_t {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t& text) override { return has_no_nul(text); }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool start_object(std::size_t) override {
    keys_.emplace_back();
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    return true;
  }
  bool key(string_t& name) override {
    if (!has_no_nul(name)) return false;
    if (keys_.back().insert(name).second) return true;
    message = "the key " + in_quotes(name) + " occurs twice in one object";
    return false;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    bytes_read = position;
    // The exception's text is "[...] parse error at line 1, column 2: what was wrong".
    const std::string what = error.what();
    const std::size_t column = what.find(", column ");
    const std::size_t colon = what.find(": ", column == std::string::npos ? what.find("] ") : column);
    message = "not valid JSON: " + (colon == std::string::npos ? what : what.substr(colon + 2));
    constexpr std::size_t kLongest = 240;
    if (message.size() > kLongest) message = message.substr(0, kLongest) + "...";
    return false;
  }

  std::string message;
  std::size_t bytes_read = 0;  // up to and with the wrong one; 0 = unknown

 private:
  // The system ends a name at its first NUL, so another file than the named one would be opened.
  bool has_no_nul(const string_t& text) {
    if (text.find('\0') == string_t::npos) return true;
    message = "the text " + in_quotes(text) + " holds a NUL character";
    return false;
  }

  std::vector<std::set<std::string>> keys_;  // of the objects that are still open
};

Error syntax_error(std::string_view text, const SyntaxCheck& check, const std::string& name) {
  Error error{printable(check.message), name, 0, 0, ""};
  if (check.bytes_read == 0) return error;
  const std::string_view before = text.substr(0, std::min(check.bytes_read - 1, text.size()));
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  error.line = 1 + static_cast<std::int64_t>(std::count(before.begin(), before.end(), '\n'));
  error.column = static_cast<std::int64_t>(before.size() - line_start) + 1;
  if (check.bytes_read > text.size()) error.hint = "the file seems to be cut off";
  return error;
}

// --- Schema -----------------------------------------------------------------------------------------------------

const json& schema_document() {
  static const json schema = *json_from_text<json>(scene_schema());
  return schema;
}

const JsonSchema& the_schema() {
  static const JsonSchema schema(schema_document());
  return schema;
}

std::string found(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  return value.is_string() ? in_quotes(value.get<std::string>()) : shortened(value.dump());
}

std::string list_of_keys(const json& properties) {
  std::string keys;
  for (const auto& property : properties.items()) keys += (keys.empty() ? "" : ", ") + property.key();
  return keys;
}

// The fault of a value that the schema refuses, at the deepest location that explains it.
Error explain(const json& value, const json& unresolved_schema, const std::string& path) {
  const json& schema = the_schema().resolved(unresolved_schema);
  const std::string place = (path.empty() ? "/" : path) + ": ";
  const auto refuse = [&](const std::string& what) { return Error{place + what, "", 0, 0, ""}; };
  const Error expected =
      refuse("expected " + schema.value("title", std::string("something else")) + ", found " + found(value));

  // Of several alternatives, explain the one with the value's type.
  if (schema.contains("anyOf")) {
    for (const json& alternative : schema.at("anyOf")) {
      const json& candidate = the_schema().resolved(alternative);
      const bool nested = candidate.contains("anyOf");
      if (nested || has_json_type(value, candidate.value("type", std::string())))
        return explain(value, alternative, path);
    }
    return expected;
  }
  if (schema.contains("type") && !has_json_type(value, schema.at("type").get<std::string>())) return expected;

  // In an object, search for unknown and missing keys, then check the values.
  if (value.is_object() && schema.contains("properties")) {
    const json& properties = schema.at("properties");
    for (const auto& member : value.items())
      if (!properties.contains(member.key())) {
        Error error = refuse("unknown key " + in_quotes(member.key()));
        error.hint = "known keys: " + list_of_keys(properties);
        return error;
      }
    if (schema.contains("required"))
      for (const json& key : schema.at("required"))
        if (!value.contains(key.get<std::string>())) return refuse("the key " + key.dump() + " is missing");
    for (const auto& member : value.items()) {
      const json& property = properties.at(member.key());
      if (!the_schema().accepts(member.value(), property))
        return explain(member.value(), property, path + "/" + member.key());
    }
  }

  // In an array, check the number of items, then the items.
  if (value.is_array() && schema.contains("items")) {
    const json& items = schema.at("items");
    const bool tuple = items.is_array();
    const std::size_t most = tuple ? items.size() : schema.value("maxItems", value.size());
    if (value.size() < schema.value("minItems", std::size_t{0}) || value.size() > most) return expected;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const json& item = tuple ? items[i] : items;
      if (!the_schema().accepts(value[i], item)) return explain(value[i], item, path + "/" + std::to_string(i));
    }
  }
  return expected;
}

}  // namespace

Result<json> parse_json(std::string_view text, const std::string& name) {
  if (Status status = check_json_depth(text, name); !status) return status.error();
  SyntaxCheck check;
  if (!json::sax_parse(text.begin(), text.end(), &check)) return syntax_error(text, check, name);
  return json_from_text<json>(text, name);
}

Status check_against_schema(const json& document, const std::string& name) {
  if (the_schema().accepts(document, schema_document())) return Done{};
  Error error = explain(document, schema_document(), "");
  error.file = name;
  return error;
}

Status check_against_definition(const json& document, const std::string& definition, const std::string& name) {
  const json& schema = schema_document().at("definitions").at(definition);
  if (the_schema().accepts(document, schema)) return Done{};
  Error error = explain(document, schema, "");
  error.file = name;
  return error;
}

}  // namespace bihive
