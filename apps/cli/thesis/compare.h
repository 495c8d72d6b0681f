// Compares our values with the thesis's: spreads, print rounding, verdicts, and tables of statements.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/bih/tree.h"
#include "bihive/scene/generators.h"
#include "thesis/section.h"
#include "thesis/stated_values.h"

namespace bihive::cli::thesis {

/// Mean and sample standard deviation; the deviation of a single value is 0.
struct Spread {
  double mean = 0, sd = 0;
};
Spread spread_of(const std::vector<double>& values);

/// Half a unit of the last digit of a printed number: "4,095" 0.5, "87.51%" 0.005.
double print_rounding(const std::string& printed);

/// Within three standard deviations; without deviation, within print rounding. If our value has no deviation and the
/// printed one is whole, the numbers must be equal.
bool inside_three_sd(double stated, const std::string& printed, const Spread& ours);

/// MAX_PRIMS and MAX_TREE_DEPTH from values.json, 0 for infinity. Fails if negative.
BuildParameters build_parameters(std::int64_t max_prims, std::int64_t max_depth);

/// The scenario with that number. Fails if there is none.
Scenario scenario_of(std::int64_t number);

std::string verdict_name(Verdict verdict);
Verdict verdict_if(bool agrees);

/// Statements of the text, one in each row, with our finding and a verdict.
class Statements {
 public:
  Statements(std::string title, std::string note);

  /// `name` is for machines. A verdict of `none` is shown as `undecided`.
  void add(const std::string& name, const std::string& statement, const std::string& thesis, const std::string& ours,
           Verdict verdict, const std::string& undecided = "");

  bool empty() const { return table_.rows.empty(); }
  const Table& table() const { return table_; }
  const Json& data() const { return data_; }

 private:
  Table table_;
  Json data_ = Json::array();
};

}  // namespace bihive::cli::thesis
