#include "thesis/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "bihive/base/json_text.h"
#include "thesis/report_template.h"

namespace bihive::cli::thesis {
namespace {

// The fate of a claim, with its words and its class of CSS.
struct Fate {
  const char *name, *words, *css_class;
};
constexpr Fate kReproduced{"reproduced", "reproduced", "agrees"};
constexpr Fate kShape{"shape_only", "shape only", "inferred"};
constexpr Fate kInferred{"inferred", "as we infer it", "inferred"};
constexpr Fate kChecked{"own_check", "own check holds", "check"};
constexpr Fate kNotInferred{"not_inferred", "not as we infer it", "differs"};
constexpr Fate kContradicted{"contradicted", "contradicted", "differs"};
constexpr Fate kUndecided{"undecided", "undecided", "undecided"};
constexpr Fate kInconsistent{"text_inconsistent", "text inconsistent", "inconsistent"};
constexpr Fate kLost{"value_lost", "value lost", "open"};
constexpr Fate kNotCompared{"not_compared", "not compared", "open"};
constexpr Fate kNotRun{"not_run", "not measured here", "open"};

// "a.*" matches every name that begins with "a.".
bool matches(const std::string& pattern, const std::string& name) {
  if (pattern.empty() || pattern.back() != '*') return pattern == name;
  return name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0;
}

std::vector<const Finding*> findings_of(const Json& claim, const Section& section) {
  std::vector<const Finding*> found;
  for (const Json& pattern : claim["findings"])
    for (const Finding& finding : section.findings)
      if (matches(pattern.get<std::string>(), finding.name)) found.push_back(&finding);
  return found;
}

// How bad a finding is: the worst one decides on its claim, and is shown.
enum Rank { kAgrees, kOpen, kSpread, kSelfContradiction, kOtherThanInferred, kOtherThanStated };
Rank rank_of(const Finding& finding) {
  switch (finding.verdict) {
    case Verdict::agrees:
      return kAgrees;
    case Verdict::none:
      return kOpen;
    case Verdict::undecided:
      return kSpread;
    case Verdict::text_inconsistent:
      return kSelfContradiction;
    case Verdict::differs:
      break;
  }
  return finding.kind == ValueKind::stated ? kOtherThanStated : kOtherThanInferred;
}

// The first of the worst; there must be one.
const Finding& worst_finding(const std::vector<const Finding*>& found) {
  return **std::max_element(found.begin(), found.end(),
                            [](const Finding* a, const Finding* b) { return rank_of(*a) < rank_of(*b); });
}

Fate fate_of(const Json& claim, const std::vector<const Finding*>& found) {
  if (claim.value("lost", false)) return kLost;
  if (claim.value("not_compared", false)) return kNotCompared;
  if (found.empty()) return kNotRun;
  switch (rank_of(worst_finding(found))) {
    case kOtherThanStated:
      return kContradicted;
    case kOtherThanInferred:
      return kNotInferred;
    case kSelfContradiction:
      return kInconsistent;
    case kSpread:
      return kUndecided;
    case kOpen:
    case kAgrees:
      break;
  }
  const auto any = [&](auto matching) {
    return std::any_of(found.begin(), found.end(), [&](const Finding* finding) { return matching(*finding); });
  };
  const auto agrees = [](const Finding& finding) { return finding.verdict == Verdict::agrees; };
  if (!any(agrees)) return kNotRun;
  const bool only_checks = !any([](const Finding& finding) { return finding.kind != ValueKind::own_check; });
  // A value that rests on an inference of ours is not the text's alone.
  if (any([](const Finding& finding) { return finding.kind == ValueKind::inferred; })) return kInferred;
  if (claim.value("shape", false) && !only_checks) return kShape;
  const bool of_text =
      any([&](const Finding& finding) { return agrees(finding) && finding.kind == ValueKind::stated; });
  return of_text ? kReproduced : kChecked;
}

// The single finding's words; of several the number of those that agree, and the words of the worst that does not.
std::string found_text(const std::vector<const Finding*>& found) {
  if (found.empty()) return "";
  if (found.size() == 1) return found.front()->ours;
  const auto agree = std::count_if(found.begin(), found.end(),
                                   [](const Finding* finding) { return finding->verdict == Verdict::agrees; });
  std::string text = fmt::format("{} of {} findings agree", agree, found.size());
  if (const Finding& worst = worst_finding(found); worst.verdict != Verdict::agrees)
    text += fmt::format("; {}: {} ({} expected)", worst.statement, worst.ours, worst.expected);
  return text;
}

}  // namespace

ReportFront verdict_page(const std::vector<ReportSection>& sections) {
  ReportFront page{"verdicts", "The verdicts", {}, {"", {"Claim of the text", "Verdict", "What we find"}, {}, ""}, {},
                   {},         Json::array()};
  page.table.title = "What the thesis claims, and what became of it here";
  std::map<std::string, int> counts;
  const Json claims = *json_from_text<Json>(thesis_claims_json());
  for (const Json& claim : claims["claims"]) {
    const auto experiment = claim["experiment"].get<std::string>();
    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const ReportSection& each) { return each.id == experiment; });
    if (section == sections.end()) continue;
    const std::vector<const Finding*> found = findings_of(claim, section->section);
    const Fate fate = fate_of(claim, found);
    ++counts[fate.words];

    // A reason that was written for contradicted claims is shown where it applies.
    std::string text = found_text(found);
    const bool because = claim.contains("reason") &&
                         (fate.name == kContradicted.name || fate.name == kNotInferred.name ||
                          fate.name == kInconsistent.name || fate.name == kChecked.name || fate.name == kLost.name ||
                          fate.name == kNotCompared.name || fate.name == kNotRun.name || fate.name == kUndecided.name);
    if (claim.contains("note")) text += (text.empty() ? "" : ". ") + claim["note"].get<std::string>();
    if (because) text += (text.empty() ? "" : ". ") + claim["reason"].get<std::string>();
    page.table.rows.push_back(
        {{fmt::format("{}: {}", claim["section"].get<std::string>(), claim["claim"].get<std::string>())},
         {fate.words},
         {text}});
    page.links.push_back(experiment);
    page.row_classes.emplace_back(fate.css_class);
    page.data.push_back({{"claim", claim["claim"]},
                         {"section", claim["section"]},
                         {"experiment", experiment},
                         {"verdict", fate.name},
                         {"found", text}});
  }
  std::string summary;
  for (const auto& [words, count] : counts)
    summary += fmt::format("{}{} {}", summary.empty() ? "" : ", ", count, words);
  page.paragraphs.push_back(
      "One line for each claim of the text that a program can look at, in the text's order (B to G). \"Reproduced\": "
      "what the text states comes out. \"Shape only\": an order or a shape comes out, not a number. \"As we infer "
      "it\": "
      "the text leaves a part open, and what we take it to mean comes out, or does not. \"Contradicted\": we find "
      "something else, for "
      "the reason that is given. \"Text inconsistent\": two sentences of the text, or a sentence and its table, "
      "exclude "
      "each other. \"Value lost\": only a picture showed it, and the picture is lost. Claims about frame rates are "
      "judged on the engine reference: the tree that we reconstructed from Table 4.2, walked by plain scalar code.");
  if (!summary.empty()) page.paragraphs.push_back("In this run: " + summary + ".");
  return page;
}

}  // namespace bihive::cli::thesis
