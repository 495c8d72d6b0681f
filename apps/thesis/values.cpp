#include "values.h"

#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "bihive/thesis/builtin_values.h"

namespace bihive::thesis {
namespace {

using cli::fail;
using cli::value_or_fail;

std::string_view builtin_values(const std::string& experiment) {
#define BIHIVE_VALUES(name, id, section, title) \
  if (experiment == id) return builtin_values_##name();
  BIHIVE_THESIS_EXPERIMENTS(BIHIVE_VALUES)
#undef BIHIVE_VALUES
  return {};
}

}  // namespace

Values::Values(const std::string& bytes, const std::string& file)
    : stated_(value_or_fail(StatedValues::parse(bytes, file))),
      document_(value_or_fail(json_from_text<nlohmann::ordered_json>(bytes, file))) {}

std::vector<std::int64_t> Values::integers(const std::string& name) const {
  std::vector<std::int64_t> all = value_or_fail(stated_.integers(name));
  for (const std::int64_t one : all)
    if (one < 1) fail({"/values/" + name + ": expected whole numbers above 0", "values.json", 0, 0, ""});
  return all;
}

std::int64_t Values::limit(const std::string& name) const {
  const std::int64_t limit = integer(name);
  if (limit < 0) fail({"/values/" + name + ": a limit cannot be negative", "values.json", 0, 0, "0 is infinity"});
  return limit == 0 ? kUnlimited : limit;
}

Scene Values::scene(std::int64_t scenario, std::int64_t spheres, std::uint64_t seed) const {
  const ScenarioParameters parameters{spheres, static_cast<float>(number("radius")), seed};
  return value_or_fail(scenario_scene(scenario_of(scenario), parameters));
}

Scenario scenario_of(std::int64_t number) {
  for (const Scenario scenario : {Scenario::grid, Scenario::corners, Scenario::mixed})
    if (static_cast<std::int64_t>(scenario) == number) return scenario;
  fail({"there is no scenario " + std::to_string(number), "values.json", 0, 0, "take 1, 2 or 3"});
}

Values load_values(const std::string& experiment, const std::string& folder) {
  const std::string file = folder + "/" + experiment + "/values.json";
  // A folder need not hold every experiment. What it holds must be readable.
  if (!folder.empty() && (access(file.c_str(), F_OK) == 0 || errno != ENOENT))
    return {value_or_fail(read_file(file)), file};
  return {std::string(builtin_values(experiment)), "thesis/" + experiment + "/values.json"};
}

}  // namespace bihive::thesis
