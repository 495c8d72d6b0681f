#include "thesis/stated_values.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "bihive/base/write_file.h"
#include "support/failure.h"
#include "thesis/builtin_values.h"

namespace bihive::cli::thesis {
namespace {

std::string_view builtin_values(const std::string& experiment) {
  using Source = std::string_view (*)();
  static const std::pair<const char*, Source> kSources[] = {
      {"figure-4.1", builtin_values_figure_4_1}, {"figure-4.2", builtin_values_figure_4_2},
      {"figure-4.3", builtin_values_figure_4_3}, {"table-4.2", builtin_values_table_4_2},
      {"figure-4.4", builtin_values_figure_4_4}, {"figure-4.5", builtin_values_figure_4_5},
      {"section-d", builtin_values_section_d}};
  for (const auto& [name, source] : kSources)
    if (experiment == name) return source();
  return {};
}

bool is_value(const Json& value) {
  if (value.is_number()) return true;
  if (!value.is_array() || value.empty()) return false;
  for (const Json& item : value)
    if (!item.is_number()) return false;
  return true;
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

Values::Values(const std::string& bytes, const std::string& file)
    : file_(file), document_(Json::parse(bytes, nullptr, /*allow_exceptions=*/false)) {
  const auto bad = [&](const std::string& place, const std::string& expected) {
    fail({place + ": expected " + expected, file_, 0, 0, ""});
  };
  if (document_.is_discarded()) bad("/", "a JSON document");
  if (!document_.is_object() || !document_.contains("values") || !document_["values"].is_object())
    bad("/values", "an object with one entry a value");
  for (const auto& [name, entry] : document_["values"].items()) {
    if (!entry.is_object() || !entry.contains("value") || !is_value(entry["value"]))
      bad("/values/" + name + "/value", "a number or a list of numbers");
    if (!entry.contains("sentence") || !entry["sentence"].is_string())
      bad("/values/" + name + "/sentence", "the sentence that it comes from");
  }
}

const Json& Values::entry(const std::string& name) const {
  if (!has(name)) fail({"/values/" + name + ": expected a value of this name", file_, 0, 0, ""});
  return document_["values"][name];
}

bool Values::has(const std::string& name) const {
  return document_["values"].contains(name);
}

double Values::number(const std::string& name) const {
  const Json& value = entry(name)["value"];
  if (!value.is_number()) fail({"/values/" + name + "/value: expected one number", file_, 0, 0, ""});
  return value.get<double>();
}

std::int64_t Values::integer(const std::string& name) const {
  const double value = number(name);
  if (value != std::floor(value) || std::abs(value) > 0x1p53)
    fail({"/values/" + name + "/value: expected a whole number", file_, 0, 0, ""});
  return static_cast<std::int64_t>(value);
}

std::vector<double> Values::numbers(const std::string& name) const {
  const Json& value = entry(name)["value"];
  if (value.is_number()) return {value.get<double>()};
  return value.get<std::vector<double>>();
}

std::string Values::printed(const std::string& name) const {
  const Json& found = entry(name);
  if (!found.contains("printed") || !found["printed"].is_string()) return found["value"].dump();
  // If only the value was changed, the printed number is out of date.
  const std::string printed = found["printed"].get<std::string>();
  const std::optional<double> number = number_in_print(printed);
  return number && found["value"] != *number ? found["value"].dump() : printed;
}

std::string Values::sentence(const std::string& name) const {
  return entry(name)["sentence"].get<std::string>();
}

Values load_values(const std::string& experiment, const std::string& folder) {
  const std::string file = folder + "/" + experiment + "/values.json";
  if (!folder.empty() && access(file.c_str(), F_OK) == 0) return {value_or_fail(read_file(file)), file};
  return {std::string(builtin_values(experiment)), "thesis/" + experiment + "/values.json"};
}

}  // namespace bihive::cli::thesis
