#include "bihive/thesis/stated_values.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bihive/base/json_text.h"

namespace bihive {
namespace {

using nlohmann::json;

// Above it not every whole number is a binary64 number.
constexpr double kMostWhole = 0x1p53;

bool is_value(const json& value) {
  if (value.is_number() || value.is_string()) return true;
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_number(); });
}

constexpr const char* kKinds[] = {"stated", "set", "fitted", "inferred", "own_check"};

bool is_whole(double number) {
  return number == std::floor(number) && std::abs(number) <= kMostWhole;
}

// The number in "4,095" or "87.51%"; nothing for texts and lists.
std::optional<double> number_in_print(std::string printed) {
  printed.erase(std::remove(printed.begin(), printed.end(), ','), printed.end());
  if (!printed.empty() && printed.back() == '%') printed.pop_back();
  if (printed.empty()) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(printed.c_str(), &end);
  return *end == '\0' ? std::optional(number) : std::nullopt;
}

}  // namespace

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
    return stated.error_at("/values", "an object with one entry per value");
  for (const auto& [name, entry] : document["values"].items()) {
    if (!entry.is_object() || !entry.contains("value") || !is_value(entry["value"]))
      return stated.error_at("/values/" + name + "/value", "a number, a list of numbers, or a text");
    if (!entry.contains("sentence") || !entry["sentence"].is_string())
      return stated.error_at("/values/" + name + "/sentence", "the sentence that it comes from");
    const json kind = entry.value("kind", json());
    if (std::find(std::begin(kKinds), std::end(kKinds), kind) == std::end(kKinds))
      return stated.error_at("/values/" + name + "/kind", R"("stated", "set", "fitted", "inferred" or "own_check")");
    const json &value = entry["value"], printed = entry.value("printed", json());
    Value& one = stated.values_[name];
    one.is_list = value.is_array();
    if (value.is_array()) one.numbers = value.get<std::vector<double>>();
    if (value.is_number()) one.numbers = {value.get<double>()};
    if (printed.is_string()) one.printed = printed.get<std::string>();
    // If only the value was changed, the printed number is out of date.
    const std::optional<double> number = number_in_print(one.printed);
    if (one.printed.empty() || (number && (!value.is_number() || *number != value)))
      one.printed = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return stated;
}

Result<StatedValues::Value> StatedValues::value(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return error_at("/values/" + name, "a value of this name");
  return found->second;
}

Result<std::vector<double>> StatedValues::numbers(const std::string& name) const {
  Result<Value> one = value(name);
  if (!one) return one.error();
  if (one->numbers.empty()) return error_at("/values/" + name + "/value", "numbers");
  return std::move(one->numbers);
}

Result<std::string> StatedValues::printed(const std::string& name) const {
  Result<Value> one = value(name);
  if (!one) return one.error();
  return std::move(one->printed);
}

Result<double> StatedValues::number(const std::string& name) const {
  const Result<Value> one = value(name);
  if (!one) return one.error();
  if (one->is_list || one->numbers.empty()) return error_at("/values/" + name + "/value", "one number");
  return one->numbers.front();
}

Result<std::int64_t> StatedValues::integer(const std::string& name) const {
  const Result<double> one = number(name);
  if (!one) return one.error();
  if (!is_whole(*one)) return error_at("/values/" + name + "/value", "a whole number");
  return static_cast<std::int64_t>(*one);
}

Result<std::vector<std::int64_t>> StatedValues::integers(const std::string& name) const {
  const Result<std::vector<double>> all = numbers(name);
  if (!all) return all.error();
  if (!std::all_of(all->begin(), all->end(), is_whole)) return error_at("/values/" + name, "whole numbers");
  return std::vector<std::int64_t>(all->begin(), all->end());
}

}  // namespace bihive
