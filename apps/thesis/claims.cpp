#include "claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/thesis/frame_rates_report.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

using cli::fail;

// A claim with more findings than these shows how many hold.
constexpr std::size_t kListed = 4;

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
  if (quantity.is_number()) return Measured{quantity.get<double>(), quantity.get<double>(), quantity.get<double>()};
  if (!quantity.is_object()) return std::nullopt;
  if (quantity.contains("median"))
    return Measured{quantity["lower"].get<double>(), quantity["median"].get<double>(), quantity["upper"].get<double>()};
  if (!quantity.contains("mean")) return std::nullopt;
  const double mean = quantity["mean"].get<double>();
  return Measured{mean, mean, mean};
}

std::string number_text(double value, const Json& entry) {
  if (entry.contains("decimals")) return fmt::format("{:.{}f}", value, entry["decimals"].get<int>());
  if (value == std::floor(value) && std::abs(value) < 1e15) return grouped(static_cast<std::int64_t>(value));
  return fmt::format("{:.4g}", value);
}

std::string text_of(const Json& quantity, const Json& entry) {
  const std::string unit = entry.value("unit", "");
  if (quantity.is_string()) return quantity.get<std::string>();
  if (quantity.is_number()) return entry.value("prefix", "") + number_text(quantity.get<double>(), entry) + unit;
  if (quantity.is_array() && entry.value("is", "") == "inside")
    return number_text(quantity[0].get<double>(), entry) + " to " + number_text(quantity[1].get<double>(), entry);
  if (quantity.is_array()) {
    std::vector<std::string> parts;
    for (const Json& part : quantity) parts.push_back(text_of(part, entry));
    return "(" + fmt::format("{}", fmt::join(parts, ", ")) + ")";
  }
  if (quantity.contains("median"))
    return fmt::format("{}{} ({} to {})", number_text(quantity["median"].get<double>(), entry), unit,
                       number_text(quantity["lower"].get<double>(), entry),
                       number_text(quantity["upper"].get<double>(), entry));
  if (quantity.contains("mean")) {
    const double sd = quantity["sd"].get<double>();
    return number_text(quantity["mean"].get<double>(), entry) +
           (sd > 0 ? fmt::format(" ± {:.2g}", sd) : std::string()) + unit;
  }
  std::vector<std::string> parts;
  const std::string prefix = entry.value("key", "Scenario ");
  for (const auto& [key, value] : quantity.items()) parts.push_back(prefix + key + ": " + text_of(value, entry));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Verdict verdict_if(bool agrees) {
  return agrees ? Verdict::agrees : Verdict::differs;
}

// Which of a map's members is extreme? Undecided where the spreads of the stated one and of another overlap.
Verdict extreme(const Json& map, const std::string& stated, bool highest) {
  if (!map.contains(stated)) return Verdict::differs;
  const Measured mine = *measured(map[stated]);
  Verdict verdict = Verdict::agrees;
  for (const auto& [key, value] : map.items()) {
    if (key == stated) continue;
    const Measured other = *measured(value);
    const bool ahead = highest ? mine.low > other.high : mine.high < other.low;
    const bool behind = highest ? mine.high <= other.low : mine.low >= other.high;
    if (behind) return Verdict::differs;
    if (!ahead) verdict = Verdict::undecided;
  }
  return verdict;
}

std::vector<std::string> by_size(const Json& map) {
  std::vector<std::pair<double, std::string>> members;
  for (const auto& [key, value] : map.items()) members.emplace_back(-measured(value)->middle, key);
  std::sort(members.begin(), members.end());
  std::vector<std::string> keys;
  keys.reserve(members.size());
  for (const auto& [size, key] : members) keys.push_back(key);
  return keys;
}

std::vector<std::string> keys_in(const Json& value) {
  std::vector<std::string> keys;
  if (value.is_string()) return {value.get<std::string>()};
  if (!value.is_array()) return {value.dump()};
  for (const Json& one : value) keys.push_back(one.dump());
  return keys;
}

// Compares a quantity with the entry's "value": a number, a list of numbers or a string.
Verdict compared(const std::string& is, const Json& quantity, const Json& entry, const std::string& printed) {
  const Json& value = entry["value"];
  const double tolerance = entry.value("tolerance", 0.0);
  const std::optional<Measured> ours = measured(quantity);
  // Numbers, lists and texts that are the same, numbers within the tolerance.
  if (is == "equal") {
    if (quantity.is_array() && value.is_array() && quantity.size() == value.size()) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (!(std::abs(quantity[i].get<double>() - value[i].get<double>()) <= tolerance)) return Verdict::differs;
      return Verdict::agrees;
    }
    if (quantity.is_number() && value.is_number())
      return verdict_if(std::abs(quantity.get<double>() - value.get<double>()) <= tolerance);
    return verdict_if(quantity == value);
  }
  // A mean over seeds: the value lies within three standard deviations, widened by half of its last printed digit.
  if (is == "within 3 sd")
    return verdict_if(
        inside_three_sd(value.get<double>(), printed, {quantity["mean"].get<double>(), quantity["sd"].get<double>()}));
  // A range of ours lies inside of the stated one.
  if (is == "inside")
    return verdict_if(quantity[0].get<double>() >= value[0].get<double>() - tolerance &&
                      quantity[1].get<double>() <= value[1].get<double>() + tolerance);
  if (is == "in range" && ours) {
    const double low = value[0].get<double>() - tolerance, high = value[1].get<double>() + tolerance;
    if (ours->low >= low && ours->high <= high) return Verdict::agrees;
    return ours->high < low || ours->low > high ? Verdict::differs : Verdict::undecided;
  }
  if (is == "above" && ours)
    return ours->low > value.get<double>()     ? Verdict::agrees
           : ours->high <= value.get<double>() ? Verdict::differs
                                               : Verdict::undecided;
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
  if (entry.contains("expects")) return entry["expects"].get<std::string>();
  if (is == "above") return "above " + printed;
  if (is == "within a factor") return fmt::format("{}, within a factor of {}", printed, entry.value("tolerance", 0.0));
  return printed;
}

Finding finding_of(const Values& values, const std::string& name, const Json& entry, const Json& quantity) {
  const std::string is = entry.value("is", "equal"), printed = values.printed(name);
  Verdict verdict = compared(is, quantity, entry, printed);
  if (verdict == Verdict::differs && entry.contains("contradicts")) verdict = Verdict::text_inconsistent;
  return {name,
          entry["claim"].get<std::string>(),
          entry.value("row", ""),
          expected_text(entry, is, printed),
          text_of(quantity, entry),
          verdict,
          values.kind(name)};
}

// From the best to the worst.
int rank(const Finding& finding) {
  if (finding.verdict == Verdict::text_inconsistent) return 3;
  if (finding.verdict == Verdict::undecided) return 2;
  if (finding.verdict == Verdict::differs) return 4;
  return 0;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "differs";
    case Verdict::undecided:
      return "undecided";
    case Verdict::text_inconsistent:
      break;
  }
  return "text_inconsistent";
}

Words words_of(Verdict verdict, ValueKind kind) {
  if (verdict == Verdict::text_inconsistent) return {"the text contradicts itself", "⚡", "inconsistent"};
  if (verdict == Verdict::undecided) return {"undecided", "?", "undecided"};
  const bool agrees = verdict == Verdict::agrees;
  switch (kind) {
    case ValueKind::stated:
      return agrees ? Words{"reproduced", "✓", "agrees"} : Words{"differs", "✗", "differs"};
    case ValueKind::set:
      return agrees ? Words{"set as stated", "=", "set"} : Words{"not set as stated", "✗", "differs"};
    case ValueKind::fitted:
      return agrees ? Words{"fitted", "≈", "fitted"} : Words{"fitted, and does not come out", "≉", "unlike"};
    case ValueKind::inferred:
      return agrees ? Words{"as we read it", "∼", "read"} : Words{"not as we read it", "≁", "unlike"};
    case ValueKind::own_check:
      break;
  }
  return agrees ? Words{"own check holds", "=", "set"} : Words{"own check fails", "✗", "differs"};
}

std::vector<Finding> judge(const Values& values, const Json& data) {
  std::vector<Finding> findings;
  for (const auto& [name, entry] : values.document()["values"].items()) {
    if (!entry.contains("claim")) continue;
    if (const Json* const quantity = at_path(data, entry.value("of", name)))
      findings.push_back(finding_of(values, name, entry, *quantity));
  }
  return findings;
}

std::vector<Finding> judge_on(const Values& values, const std::string& name, const Json& data,
                              const std::string& path) {
  const Json* const quantity = at_path(data, path);
  if (quantity == nullptr) return {};
  return {finding_of(values, name, values.document()["values"][name], *quantity)};
}

std::vector<Claim> claims_of(const Experiment& experiment, const Values& values, const std::vector<Finding>& findings) {
  std::vector<Claim> claims;
  const auto begin = [&](const Json& entry) {
    claims.push_back({entry.value("section", experiment.section),
                      entry["claim"].get<std::string>(),
                      experiment.id,
                      entry.value("sentence", ""),
                      {},
                      {"not run", "–", "open"},
                      "not_run",
                      "",
                      {}});
    return claims.end() - 1;
  };
  std::map<std::string, std::pair<std::string, std::string>> notes;  // by claim: note, reason
  for (const auto& [name, entry] : values.document()["values"].items()) {
    if (!entry.contains("claim")) continue;
    auto claim = std::find_if(claims.begin(), claims.end(), [&, &one = entry](const Claim& each) {
      return each.claim == one["claim"].get<std::string>();
    });
    if (claim == claims.end()) claim = begin(entry);
    for (const Json& test : entry.value("held_by", Json::array())) claim->held_by.push_back(test.get<std::string>());
    auto& [note, reason] = notes[claim->claim];
    if (entry.contains("note")) note = entry["note"].get<std::string>();
    if (entry.contains("reason")) reason = entry["reason"].get<std::string>();
    const auto finding = std::find_if(findings.begin(), findings.end(),
                                      [&, &wanted = name](const Finding& each) { return each.name == wanted; });
    if (finding != findings.end()) claim->findings.push_back(&*finding);
  }

  for (Claim& claim : claims) {
    if (claim.findings.empty()) continue;
    const Finding& worst = **std::max_element(claim.findings.begin(), claim.findings.end(),
                                              [](const Finding* a, const Finding* b) { return rank(*a) < rank(*b); });
    claim.words = words_of(worst.verdict, worst.kind);
    claim.verdict = std::string(name_of(worst.kind)) + "_" + name_of(worst.verdict);
    const auto holding = std::count_if(claim.findings.begin(), claim.findings.end(),
                                       [](const Finding* each) { return each->verdict == Verdict::agrees; });
    if (claim.findings.size() > kListed)
      claim.found = fmt::format("{} of {}", holding, claim.findings.size());
    else
      for (const Finding* const each : claim.findings)
        claim.found += (claim.found.empty() ? "" : "; ") + (each->row.empty() ? "" : each->row + ": ") + each->ours;
    const auto& [note, reason] = notes[claim.claim];
    for (const std::string& more : {note, worst.verdict == Verdict::agrees ? std::string() : reason})
      if (!more.empty()) claim.found += ". " + more;
  }
  for (const Json& remark : values.document().value("remarks", Json::array())) {
    const auto claim = begin(remark);
    const std::string verdict = remark["verdict"].get<std::string>();
    claim->words = verdict == "tested"       ? Words{"so in this program", "=", "set"}
                   : verdict == "value_lost" ? Words{"value lost", "–", "open"}
                                             : Words{"not compared", "–", "open"};
    claim->verdict = verdict;
    claim->found = remark["reason"].get<std::string>();
    for (const Json& test : remark.value("held_by", Json::array())) claim->held_by.push_back(test.get<std::string>());
  }
  return claims;
}

}  // namespace bihive::thesis
