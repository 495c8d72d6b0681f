#include "bihive/thesis/stated_values.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bihive/base/json_text.h"

namespace bihive {
namespace {

using nlohmann::json;

// Beyond it not every whole number is a binary64 number.
constexpr double kMostWhole = 0x1p53;

bool is_value(const json& value) {
  if (value.is_number() || value.is_string()) return true;
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_number(); });
}

constexpr std::pair<ValueKind, const char*> kKinds[] = {{ValueKind::stated, "stated"},
                                                        {ValueKind::set, "set"},
                                                        {ValueKind::fitted, "fitted"},
                                                        {ValueKind::inferred, "inferred"},
                                                        {ValueKind::own_check, "own_check"}};

std::optional<ValueKind> kind_named(const json& name) {
  for (const auto& [kind, word] : kKinds)
    if (name == word) return kind;
  return std::nullopt;
}

bool is_whole(double number) {
  return number == std::floor(number) && std::abs(number) <= kMostWhole;
}

// The number in "4,095" or "87.51%"; nothing for words and lists.
std::optional<double> number_in_print(std::string printed) {
  printed.erase(std::remove(printed.begin(), printed.end(), ','), printed.end());
  if (!printed.empty() && printed.back() == '%') printed.pop_back();
  if (printed.empty()) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(printed.c_str(), &end);
  return *end == '\0' ? std::optional(number) : std::nullopt;
}

}  // namespace

const char* name_of(ValueKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].second;
}

Error StatedValues::error_at(const std::string& place, const std::string& expected) const {
  return {place + ": expected " + expected, file_, 0, 0, ""};
}

Result<StatedValues> StatedValues::parse(std::string_view bytes, std::string file) {
  StatedValues stated;
  stated.file_ = std::move(file);
  stated.text_ = bytes;
  const Result<json> parsed = json_from_text<json>(bytes, stated.file_);
  if (!parsed) return parsed.error();
  const json& document = *parsed;
  if (!document.is_object() || !document.contains("values") || !document["values"].is_object())
    return stated.error_at("/values", "an object with one entry a value");
  for (const auto& [name, entry] : document["values"].items()) {
    if (!entry.is_object() || !entry.contains("value") || !is_value(entry["value"]))
      return stated.error_at("/values/" + name + "/value", "a number, a list of numbers, or a text");
    if (!entry.contains("sentence") || !entry["sentence"].is_string())
      return stated.error_at("/values/" + name + "/sentence", "the sentence that it comes from");
    const std::optional<ValueKind> kind = kind_named(entry.value("kind", json()));
    if (!kind)
      return stated.error_at("/values/" + name + "/kind", R"("stated", "set", "fitted", "inferred" or "own_check")");
    const json& value = entry["value"];
    const bool is_list = !value.is_number(), is_printed = entry.contains("printed") && entry["printed"].is_string();
    std::vector<double> numbers;
    if (value.is_array()) numbers = value.get<std::vector<double>>();
    if (value.is_number()) numbers = {value.get<double>()};
    stated.values_[name] = {std::move(numbers),
                            is_list,
                            value.is_string() ? value.get<std::string>() : value.dump(),
                            is_printed ? entry["printed"].get<std::string>() : "",
                            entry["sentence"].get<std::string>(),
                            *kind};
  }
  return stated;
}

Result<const StatedValues::Value*> StatedValues::find(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return error_at("/values/" + name, "a value of this name");
  return &found->second;
}

Result<double> StatedValues::number(const std::string& name) const {
  const Result<const Value*> value = find(name);
  if (!value) return value.error();
  if ((*value)->is_list) return error_at("/values/" + name + "/value", "one number");
  return (*value)->numbers.front();
}

Result<std::int64_t> StatedValues::integer(const std::string& name) const {
  const Result<double> value = number(name);
  if (!value) return value.error();
  if (!is_whole(*value)) return error_at("/values/" + name + "/value", "a whole number");
  return static_cast<std::int64_t>(*value);
}

Result<std::vector<double>> StatedValues::numbers(const std::string& name) const {
  const Result<const Value*> value = find(name);
  if (!value) return value.error();
  if ((*value)->numbers.empty()) return error_at("/values/" + name + "/value", "numbers");
  return (*value)->numbers;
}

Result<std::vector<std::int64_t>> StatedValues::integers(const std::string& name) const {
  const Result<const Value*> value = find(name);
  if (!value) return value.error();
  std::vector<std::int64_t> whole;
  for (const double number : (*value)->numbers) {
    if (!is_whole(number)) return error_at("/values/" + name, "whole numbers");
    whole.push_back(static_cast<std::int64_t>(number));
  }
  return whole;
}

Result<std::string> StatedValues::printed(const std::string& name) const {
  const Result<const Value*> value = find(name);
  if (!value) return value.error();
  const auto& [numbers, is_list, text, printed, sentence, kind] = **value;
  if (printed.empty()) return text;
  // If only the value was changed, the printed number is out of date.
  const std::optional<double> number = number_in_print(printed);
  return number && (is_list || numbers.front() != *number) ? text : printed;
}

Result<std::string> StatedValues::sentence(const std::string& name) const {
  const Result<const Value*> value = find(name);
  if (!value) return value.error();
  return (*value)->sentence;
}

Result<ValueKind> StatedValues::kind(const std::string& name) const {
  const Result<const Value*> value = find(name);
  if (!value) return value.error();
  return (*value)->kind;
}

}  // namespace bihive
