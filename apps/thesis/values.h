// The values of an experiment (bihive/thesis/stated_values.h) with their claims. If a value is missing or of another
// kind, the program fails (failure.h), because every value that code needs must be in the file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/bih/tree.h"
#include "bihive/job/failure.h"
#include "bihive/scene/generators.h"
#include "bihive/thesis/stated_values.h"

namespace bihive::thesis {

using Json = nlohmann::ordered_json;

class Values {
 public:
  /// Reads folder/<experiment>/values.json if a folder is given and has that file, else the built-in text.
  Values(const std::string& experiment, std::string_view builtin, const std::string& folder);

  bool has(const std::string& name) const { return stated_.has(name); }
  double number(const std::string& name) const { return value_or_fail(stated_.number(name)); }
  std::int64_t integer(const std::string& name) const { return value_or_fail(stated_.integer(name)); }
  std::vector<double> numbers(const std::string& name) const { return value_or_fail(stated_.numbers(name)); }
  /// Whole numbers above 0.
  std::vector<std::int64_t> integers(const std::string& name) const;
  /// A limit of a tree: 0 means infinity.
  std::int64_t limit(const std::string& name) const;
  /// A side of a picture in pixels, 1 to 65535; `divisor`: of a smaller one.
  int side(const std::string& name, int divisor = 1) const;
  std::string printed(const std::string& name) const { return value_or_fail(stated_.printed(name)); }
  const StatedValues& stated() const { return stated_; }
  /// The whole file: "values", each with its claim if it has one, and "remarks": claims without a comparison.
  const Json& document() const { return document_; }

  /// The scene of a scenario with `count` spheres, of the value "radius". Fails if there is no such scenario.
  Scene scene(std::int64_t scenario, std::int64_t spheres, std::uint64_t seed) const;

 private:
  StatedValues stated_;
  Json document_;
};

/// The scenario with that number. Fails if there is none.
Scenario scenario_of(std::int64_t number);

[[noreturn]] inline void fail_value(const std::string& name, const std::string& fault) {
  fail({"/values/" + name + ": " + fault, "values.json", 0, 0, ""});
}

}  // namespace bihive::thesis
