#include "thesis/compare.h"

#include <fmt/format.h>

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

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "differs";
    case Verdict::undecided:
      return "undecided";
    case Verdict::text_inconsistent:
      return "text_inconsistent";
    case Verdict::none:
      break;
  }
  return "none";
}

std::string words_of(Verdict verdict, ValueKind kind) {
  switch (verdict) {
    case Verdict::agrees:
      return kind == ValueKind::stated ? "agrees" : kind == ValueKind::inferred ? "as inferred" : "check holds";
    case Verdict::differs:
      return kind == ValueKind::stated ? "differs" : kind == ValueKind::inferred ? "not as inferred" : "check fails";
    case Verdict::undecided:
      return "undecided";
    case Verdict::text_inconsistent:
      return "the text contradicts itself";
    case Verdict::none:
      break;
  }
  return "";
}

Verdict verdict_if(bool agrees) {
  return agrees ? Verdict::agrees : Verdict::differs;
}

Verdict verdict_above(const Quartiles& ours, double limit) {
  if (ours.lower > limit) return Verdict::agrees;
  return ours.upper <= limit ? Verdict::differs : Verdict::undecided;
}

Verdict verdict_between(const Quartiles& ours, double low, double high) {
  if (ours.lower >= low && ours.upper <= high) return Verdict::agrees;
  return ours.upper < low || ours.lower > high ? Verdict::differs : Verdict::undecided;
}

std::string quartiles_text(const Quartiles& quartiles, int decimals) {
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", quartiles.median, decimals, quartiles.lower, decimals,
                     quartiles.upper, decimals);
}

std::string source_text(ValueKind kind) {
  if (kind == ValueKind::stated) return "the text";
  return kind == ValueKind::inferred ? "inferred" : "own check";
}

Statements::Statements(std::string title, std::string note) {
  table_.title = std::move(title);
  table_.columns = {"Statement", "Expected", "By", "Ours", "Verdict"};
  table_.note = std::move(note);
}

void Statements::add(const std::string& name, const std::string& statement, const Expected& expected,
                     const std::string& ours, Verdict verdict, const std::string& why, bool timed) {
  const std::string words = words_of(verdict, expected.kind);
  table_.rows.push_back({{statement},
                         {expected.text},
                         {source_text(expected.kind)},
                         {ours},
                         {words + (why.empty() ? "" : ": " + why), verdict, expected.kind}});
  findings_.push_back({name, statement, expected.text, ours, verdict, expected.kind, timed});
  data_.push_back({{"name", name},
                   {"statement", statement},
                   {"thesis", expected.text},
                   {"kind", name_of(expected.kind)},
                   {"ours", ours},
                   {"verdict", name_of(verdict)}});
}

void Statements::move_into(Section& section, const std::string& prefix) {
  for (Finding& finding : findings_) {
    finding.name = prefix + finding.name;
    section.findings.push_back(std::move(finding));
  }
  findings_.clear();
  section.tables.push_back(std::move(table_));
}

}  // namespace bihive::cli::thesis
