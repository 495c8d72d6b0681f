#include "claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/json_text.h"
#include "bihive/base/readable.h"

namespace bihive::thesis {
namespace {

// A claim with more findings than this shows how many hold; a map shows this many members, the extreme one first.
constexpr std::size_t kListed = 5, kMembers = 3;

// Verdicts, from the best to the worst.
constexpr const char *kAgrees = "agrees", *kUndecided = "undecided", *kInconsistent = "text_inconsistent",
                     *kDiffers = "differs";
int rank(const Json& finding) {
  const std::string verdict = finding["verdict"];
  return verdict == kAgrees ? 0 : verdict == kUndecided ? 1 : verdict == kInconsistent ? 2 : 3;
}

// The quantity at a path like "trees.b.leaves"; null if there is none.
const Json* at_path(const Json& data, const std::string& path) {
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  const Json::json_pointer place(pointer);
  return data.contains(place) && !data.at(place).is_null() ? &data.at(place) : nullptr;
}

// A quantity with its spread: {"lower", "median", "upper"}, {"mean", "sd"}, or a number without any.
struct Measured {
  double low, middle, high;
};
std::optional<Measured> measured(const Json& quantity) {
  if (quantity.is_object() && quantity.contains("median"))
    return Measured{quantity["lower"], quantity["median"], quantity["upper"]};
  const Json& number = quantity.is_object() && quantity.contains("mean") ? quantity["mean"] : quantity;
  if (!number.is_number()) return std::nullopt;
  return Measured{number, number, number};
}

std::string number_text(double value, const Json& entry) {
  if (entry.contains("decimals")) return fmt::format("{:.{}f}", value, entry["decimals"].get<int>());
  if (value == std::floor(value) && std::abs(value) < 1e15) return grouped(static_cast<std::int64_t>(value));
  return fmt::format("{:.4g}", value);
}

// Keys of a map, the largest member first.
std::vector<std::string> by_size(const Json& map) {
  std::vector<std::pair<double, std::string>> members;
  for (const auto& [key, value] : map.items()) members.emplace_back(-measured(value)->middle, key);
  std::sort(members.begin(), members.end());
  std::vector<std::string> keys;
  for (auto& [size, key] : members) keys.push_back(std::move(key));
  return keys;
}

std::string text_of(const Json& quantity, const Json& entry) {
  const std::string unit = entry.value("unit", ""), prefix = entry.value("prefix", ""), is = entry.value("is", "");
  const auto number = [&](const Json& of) { return number_text(of.get<double>(), entry); };
  if (entry.contains("zero") && quantity.is_number() && quantity == 0) return entry["zero"];
  if (quantity.is_string()) return prefix + quantity.get<std::string>() + unit;
  if (quantity.is_number()) return prefix + number(quantity) + unit;
  if (quantity.is_array() && is == "inside") return number(quantity[0]) + " to " + number(quantity[1]);
  if (quantity.contains("median"))
    return fmt::format("{}{}{} ({} to {})", prefix, number(quantity["median"]), unit, number(quantity["lower"]),
                       number(quantity["upper"]));
  if (quantity.contains("mean")) {
    const double sd = quantity["sd"];
    return number(quantity["mean"]) + (sd > 0 ? fmt::format(" ± {:.2g}", sd) : "") + unit;
  }
  std::vector<std::string> parts;
  if (quantity.is_array()) {
    for (const Json& part : quantity) parts.push_back(number(part));
    return fmt::format("{}({}){}", prefix, fmt::join(parts, ", "), unit);
  }
  std::vector<std::string> keys = by_size(quantity);
  if (is == "lowest") std::reverse(keys.begin(), keys.end());
  keys.resize(std::min(keys.size(), kMembers));
  for (const std::string& key : keys)
    parts.push_back(entry.value("key", "Scenario ") + key + ": " + text_of(quantity[key], entry));
  return fmt::format("{}", fmt::join(parts, ", "));
}

const char* verdict_if(bool agrees) {
  return agrees ? kAgrees : kDiffers;
}

// Which of a map's members is extreme? Undecided where the spreads of the stated one and of another overlap.
const char* extreme(const Json& map, const std::string& stated, bool highest) {
  if (!map.contains(stated)) return kDiffers;
  const Measured mine = *measured(map[stated]);
  const char* verdict = kAgrees;
  for (const auto& [key, value] : map.items()) {
    if (key == stated) continue;
    const Measured other = *measured(value);
    const bool ahead = highest ? mine.low > other.high : mine.high < other.low;
    const bool beyond = highest ? mine.high <= other.low : mine.low >= other.high;
    if (beyond) return kDiffers;
    if (!ahead) verdict = kUndecided;
  }
  return verdict;
}

std::vector<std::string> keys_in(const Json& value) {
  if (value.is_string()) return {value.get<std::string>()};
  std::vector<std::string> keys;
  for (const Json& one : value) keys.push_back(one.dump());
  return keys;
}

// Half a unit of the last digit of a printed number: "4,095" 0.5, "87.51%" 0.005.
double print_rounding(const std::string& printed) {
  double unit = 1;
  if (const std::size_t point = printed.find('.'); point != std::string::npos)
    for (std::size_t i = point + 1; i < printed.size() && printed[i] >= '0' && printed[i] <= '9'; ++i) unit /= 10;
  return unit / 2;
}

// Within three standard deviations, widened by the print's rounding. If our value has no deviation and the printed one
// is whole, the numbers must be equal.
bool inside_three_sd(double stated, const std::string& printed, double mean, double sd) {
  const double rounding = print_rounding(printed);
  if (rounding == 0.5 && sd == 0) return stated == mean;
  // Slightly more than the rounding itself, because 0.005 is not a binary number.
  return std::abs(stated - mean) <= 3 * sd + rounding * (1 + 1e-9);
}

// Numbers, lists and texts that are the same, numbers within the tolerance.
bool equal(const Json& quantity, const Json& value, double tolerance) {
  if (quantity.is_number() && value.is_number())
    return std::abs(quantity.get<double>() - value.get<double>()) <= tolerance;
  if (!quantity.is_array() || !value.is_array()) return quantity == value;
  return std::equal(quantity.begin(), quantity.end(), value.begin(), value.end(),
                    [&](const Json& a, const Json& b) { return equal(a, b, tolerance); });
}

// Compares a quantity with the entry's "value": a number, a list of numbers or a string.
const char* compared(const std::string& is, const Json& quantity, const Json& entry, const std::string& printed) {
  const Json& value = entry["value"];
  const double tolerance = entry.value("tolerance", 0.0);
  const std::optional<Measured> ours = measured(quantity);
  if (is == "equal") return verdict_if(equal(quantity, value, tolerance));
  // A mean over seeds.
  if (is == "within 3 sd") return verdict_if(inside_three_sd(value, printed, quantity["mean"], quantity["sd"]));
  // A range of ours lies inside of the stated one.
  if (is == "inside")
    return verdict_if(quantity[0].get<double>() >= value[0].get<double>() - tolerance &&
                      quantity[1].get<double>() <= value[1].get<double>() + tolerance);
  if (is == "in range" && ours) {
    const double low = value[0].get<double>() - tolerance, high = value[1].get<double>() + tolerance;
    if (ours->low >= low && ours->high <= high) return kAgrees;
    return ours->high < low || ours->low > high ? kDiffers : kUndecided;
  }
  if (is == "above" && ours) {
    const double limit = value;
    return ours->low > limit ? kAgrees : ours->high <= limit ? kDiffers : kUndecided;
  }
  // A gain in percent: the speed-up lies within the factor `tolerance` of the stated one.
  if (is == "within a factor" && ours) {
    const double ratio = (100 + ours->middle) / (100 + value.get<double>());
    return verdict_if(ratio <= tolerance && ratio >= 1 / tolerance);
  }
  // A map of quantities: which is the highest, the lowest; their order from the highest to the lowest.
  if (is == "highest" || is == "lowest") return extreme(quantity, keys_in(value).front(), is == "highest");
  if (is == "in order") return verdict_if(by_size(quantity) == keys_in(value));
  fail({"/values: there is no comparison \"" + is + "\" of such a quantity", "values.json", 0, 0, ""});
}

std::string expected_text(const Json& entry, const std::string& is, const std::string& printed) {
  if (entry.contains("expects")) return entry["expects"];
  if (entry["value"].is_array() && !entry.contains("printed")) return text_of(entry["value"], {{"is", is}});
  if (is == "above") return "above " + printed;
  if (is == "within a factor") return fmt::format("{}, within a factor of {}", printed, entry.value("tolerance", 0.0));
  return printed;
}

// Sums up a claim's findings: its verdict is the worst of theirs, and its entries add notes and reasons.
void conclude(Json& claim, const std::vector<Json>& findings, const Json& entries) {
  if (findings.empty()) return;
  const Json& worst = *std::max_element(findings.begin(), findings.end(),
                                        [](const Json& a, const Json& b) { return rank(a) < rank(b); });
  claim["verdict"] = worst["kind"].get<std::string>() + "_" + worst["verdict"].get<std::string>();
  std::vector<std::string> ours;
  for (const Json& each : findings)
    ours.push_back((each["row"] == "" ? "" : each["row"].get<std::string>() + ": ") + each["ours"].get<std::string>());
  const auto holding =
      std::count_if(findings.begin(), findings.end(), [](const Json& each) { return rank(each) == 0; });
  const bool all = holding == static_cast<std::ptrdiff_t>(findings.size());
  std::string found = findings.size() <= kListed ? fmt::format("{}", fmt::join(ours, "; "))
                      : all                      ? fmt::format("All {} agree", holding)
                                                 : fmt::format("{} of {} agree", holding, findings.size());
  std::string note, reason;
  for (const Json& entry : entries) {
    note = entry.value("note", note);
    reason = entry.value("reason", reason);
  }
  if (!note.empty()) found += ". " + note;
  claim["why"] = rank(worst) > 0 ? reason : "";
  claim["found"] = found;
}

}  // namespace

Json judge(const Values& values, const Json& data) {
  Json findings = Json::array();
  for (const auto& [name, entry] : values.document()["values"].items()) {
    if (!entry.contains("claim")) continue;
    const Json* const quantity = at_path(data, entry.value("of", name));
    if (quantity == nullptr) continue;
    const std::string is = entry.value("is", "equal"), printed = values.printed(name);
    std::string verdict = compared(is, *quantity, entry, printed);
    if (verdict == kDiffers && entry.contains("contradicts")) verdict = kInconsistent;
    findings.push_back({{"name", name},
                        {"claim", entry["claim"]},
                        {"row", entry.value("row", "")},
                        {"kind", entry["kind"]},
                        {"expected", expected_text(entry, is, printed)},
                        {"ours", text_of(*quantity, entry)},
                        {"verdict", verdict}});
  }
  return findings;
}

Json words_of(const std::string& verdict) {
  static const Json kWords = value_or_fail(json_from_text<Json>(thesis_template_verdicts(), "verdicts.json"));
  for (const char* const of_all_kinds : {kUndecided, kInconsistent})
    if (verdict.ends_with(of_all_kinds)) return kWords.at(of_all_kinds);
  return kWords.at(verdict);
}

Json words_of(const Json& finding) {
  return words_of(finding["kind"].get<std::string>() + "_" + finding["verdict"].get<std::string>());
}

Json claims_of(const Experiment& experiment) {
  Json entries_of = Json::object();  // by claim, in the order of the file
  for (const Json& entry : experiment.values.document()["values"])
    if (entry.contains("claim")) entries_of[entry["claim"].get<std::string>()].push_back(entry);
  Json all = Json::array();
  const auto begin = [&](const Json& entry, const std::string& verdict, const std::string& found) -> Json& {
    return all.emplace_back(Json{{"section", entry.value("section", experiment.section)},
                                 {"claim", entry["claim"]},
                                 {"experiment", experiment.id},
                                 {"verdict", verdict},
                                 {"found", found},
                                 {"sentence", entry["sentence"]}});
  };
  for (const auto& [claim, entries] : entries_of.items()) {
    std::vector<Json> findings;
    std::copy_if(experiment.findings.begin(), experiment.findings.end(), std::back_inserter(findings),
                 [&name = claim](const Json& finding) { return finding["claim"] == name; });
    Json& one = begin(entries.front(), "not_run", "");
    conclude(one, findings, entries);
    // Gains in percent are told with the costs of a ray's steps that make them.
    const std::string where = experiment.data.value(Json::json_pointer("/claims_at_costs/where"), "");
    const std::string unit = entries.front().value("unit", "");
    const bool gain = unit.starts_with(" %") || unit.starts_with(" percent");
    const auto add = [&found = one["found"]](const std::string& more) {
      const std::string before = found;
      found = before + (before.ends_with('.') ? " " : ". ") + more;
    };
    if (gain && !where.empty() && entries.front().value("of", "").starts_with("at.text.")) add("At " + where + ".");
    one["numbers"] = one["found"];
    if (const std::string why = one.value("why", ""); !why.empty()) add(why);
  }
  for (const Json& remark : experiment.values.document().value("remarks", Json::array()))
    begin(remark, remark["verdict"], remark["reason"]);
  for (Json& claim : all) claim.update(words_of(claim["verdict"].get<std::string>()));
  return all;
}

}  // namespace bihive::thesis
