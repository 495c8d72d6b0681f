#include "values.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"

namespace bihive::thesis {

Values::Values(const std::string& experiment, std::string_view builtin, const std::string& folder) {
  std::string file = folder + "/" + experiment + "/values.json";
  // A folder may lack experiments, but a file that exists must be readable.
  const bool own = !folder.empty() && (access(file.c_str(), F_OK) == 0 || errno != ENOENT);
  if (!own) file = "thesis/" + experiment + "/values.json";
  const std::string bytes = own ? value_or_fail(read_file(file)) : std::string(builtin);
  stated_ = value_or_fail(StatedValues::parse(bytes, file));
  document_ = value_or_fail(json_from_text<Json>(bytes, file));
}

std::vector<std::int64_t> Values::integers(const std::string& name) const {
  std::vector<std::int64_t> all = value_or_fail(stated_.integers(name));
  if (*std::min_element(all.begin(), all.end()) < 1) fail_value(name, "expected whole numbers above 0");
  return all;
}

std::int64_t Values::limit(const std::string& name) const {
  const std::int64_t limit = integer(name);
  if (limit < 0) fail_value(name, "a limit cannot be negative; 0 is infinity");
  return limit == 0 ? kUnlimited : limit;
}

int Values::side(const std::string& name, int divisor) const {
  constexpr std::int64_t kLargestPx = 65535;
  const std::int64_t px = integer(name);
  if (px < 1 || px > kLargestPx) fail_value(name, "expected 1 to 65535 pixels");
  return std::max(1, static_cast<int>(px) / divisor);
}

Scene Values::scene(std::int64_t scenario, std::int64_t spheres, std::uint64_t seed) const {
  const ScenarioParameters parameters{spheres, static_cast<float>(number("radius")), seed};
  return value_or_fail(scenario_scene(scenario_of(scenario), parameters));
}

Scenario scenario_of(std::int64_t number) {
  if (number < 1 || number > 3)
    fail({"there is no scenario " + std::to_string(number), "values.json", 0, 0, "take 1, 2 or 3"});
  return static_cast<Scenario>(number);
}

}  // namespace bihive::thesis
