// Compares our values with the thesis's: spreads, print rounding, verdicts, and tables of statements.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/bih/tree.h"
#include "bihive/math/quartiles.h"
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

Verdict verdict_if(bool agrees);

/// The verdict on "ours is above the limit", from repeated measurements: undecided where the quartiles reach across.
Verdict verdict_above(const Quartiles& ours, double limit);
/// The verdict on "ours lies between the limits".
Verdict verdict_between(const Quartiles& ours, double low, double high);

/// "1.020 (0.990 to 1.040)": the median and the quartiles.
std::string quartiles_text(const Quartiles& quartiles, int decimals);

/// What is expected, and by whom. A bare text is the thesis's.
struct Expected {
  std::string text;
  ValueKind kind = ValueKind::stated;

  Expected(std::string said) : text(std::move(said)) {}  // NOLINT(google-explicit-constructor)
  Expected(const char* said) : text(said) {}             // NOLINT(google-explicit-constructor)
  Expected(std::string said, ValueKind whose) : text(std::move(said)), kind(whose) {}
  Expected(const Values& values, const std::string& name) : text(values.printed(name)), kind(values.kind(name)) {}
};

/// "the text", "inferred", "own check": who expects it.
std::string source_text(ValueKind kind);

/// Statements of the text, one in each row, with our finding and a verdict.
class Statements {
 public:
  Statements(std::string title, std::string note);

  /// `name` is for machines. `why` is shown beside the words of the verdict. `timed`: see Finding.
  void add(const std::string& name, const std::string& statement, const Expected& expected, const std::string& ours,
           Verdict verdict, const std::string& why = "", bool timed = false);

  bool empty() const { return table_.rows.empty(); }
  const Table& table() const { return table_; }
  const Json& data() const { return data_; }

  /// The table and its findings; `prefix` stands before their names.
  void move_into(Section& section, const std::string& prefix = "");

 private:
  Table table_;
  Json data_ = Json::array();
  std::vector<Finding> findings_;
};

}  // namespace bihive::cli::thesis
