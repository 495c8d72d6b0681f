#include "thesis/compare.h"

#include <algorithm>
#include <cmath>

#include "support/failure.h"

namespace bihive::cli::thesis {

Spread spread_of(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  if (values.empty()) return {};
  double sum = 0;
  for (const double value : values) sum += value;
  const double mean = sum / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

double print_rounding(const std::string& printed) {
  const std::size_t point = printed.find('.');
  double unit = 1;
  if (point != std::string::npos)
    for (std::size_t i = point + 1; i < printed.size() && printed[i] >= '0' && printed[i] <= '9'; ++i) unit /= 10;
  return unit / 2;
}

bool inside_three_sd(double stated, const std::string& printed, const Spread& ours) {
  // Slightly more than the rounding itself, because 0.005 is no binary number.
  const double allowed = 3 * ours.sd + print_rounding(printed) * (1 + 1e-9);
  const bool whole = print_rounding(printed) == 0.5;
  if (whole && ours.sd == 0) return stated == ours.mean;
  return std::abs(stated - ours.mean) <= allowed;
}

BuildParameters build_parameters(std::int64_t max_prims, std::int64_t max_depth) {
  if (max_prims < 0 || max_depth < 0)
    fail({"MAX_PRIMS and MAX_TREE_DEPTH cannot be negative", "values.json", 0, 0, "0 stands for infinity"});
  const auto limit = [](std::int64_t value) { return value == 0 ? kUnlimited : value; };
  return {limit(max_prims), limit(max_depth)};
}

Scenario scenario_of(std::int64_t number) {
  for (const Scenario scenario : {Scenario::grid, Scenario::corners, Scenario::mixed})
    if (static_cast<std::int64_t>(scenario) == number) return scenario;
  fail({"there is no scenario " + std::to_string(number), "values.json", 0, 0, "take 1, 2 or 3"});
}

std::string verdict_name(Verdict verdict) {
  if (verdict == Verdict::agrees) return "agrees";
  return verdict == Verdict::differs ? "differs" : "none";
}

Verdict verdict_if(bool agrees) {
  return agrees ? Verdict::agrees : Verdict::differs;
}

Statements::Statements(std::string title, std::string note) {
  table_.title = std::move(title);
  table_.columns = {"Statement", "Thesis", "Ours", "Verdict"};
  table_.note = std::move(note);
}

void Statements::add(const std::string& name, const std::string& statement, const std::string& thesis,
                     const std::string& ours, Verdict verdict, const std::string& undecided) {
  const std::string shown = verdict == Verdict::none ? undecided : verdict_name(verdict);
  table_.rows.push_back({{statement}, {thesis}, {ours}, {shown, verdict}});
  data_.push_back({{"name", name},
                   {"statement", statement},
                   {"thesis", thesis},
                   {"ours", ours},
                   {"verdict", verdict_name(verdict)}});
}

}  // namespace bihive::cli::thesis
