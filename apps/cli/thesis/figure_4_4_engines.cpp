// Figure 4.4 by the clock: one block an engine with its chart, its curves and the text's statements.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "bihive/base/write_file.h"
#include "bihive/image/svg_chart.h"
#include "bihive/math/quartiles.h"
#include "bihive/thesis/frame_rates_report.h"
#include "support/failure.h"
#include "thesis/figure_4_4.h"
#include "thesis/frame_verdicts.h"

namespace bihive::cli::thesis {
namespace {

// Brute force counts as equal in all scenarios if the fastest is ahead of the slowest by at most this.
constexpr double kStable = 0.10;
// Behind the rules of the engines that are not the text's.
const char* const kOtherEngine =
    " The text says this of its own tree, in its own program. That this engine behaves alike is our inference, so no "
    "row "
    "agrees with the text or differs from it.";

// A spread has as many digits as the rate beside it.
int digits_of(double fps) {
  return fps < 100 ? 2 : 1;
}
std::string fps_text(double fps) {
  return fmt::format("{:.{}f}", fps, digits_of(fps));
}

Series::Spread spread_of_fps(const std::vector<double>& ms) {
  const Quartiles fps = fps_quartiles(ms);
  return {fps.lower, fps.upper};
}

// One engine's block.
class EngineBlock {
 public:
  EngineBlock(const SectionContext& context, const ComparedEngine& engine)
      : context_(context),
        engine_(engine),
        scenarios_(values().integers("scenarios")),
        counts_(values().integers("spheres_list")),
        max_prims_(values().integers("max_prims_list")),
        times_(engine_times(context, engine)) {}

  void add_to(Section& section) {
    if (!times_.empty()) {
      block_.title = fmt::format("Engine {}: {}", engine_.name, words());
      block_.pairs = true;
      block_.paragraphs.push_back(method());
      if (const std::string gpu = gpu_name(); !gpu.empty())
        block_.paragraphs.push_back(
            "Here it ran on: " + gpu +
            ". Where that names llvmpipe or SwiftShader, the processor's own cores stood in for a graphics processor.");
      add_bars();
      add_curves();
      block_.tables.push_back(frame_rates());
      add_judgements(section);
    }
    if (const auto found = context_.results.find(independence_step(engine_));
        found != context_.results.end() && !why_missing(found->second))
      add_independence(found->second, section);
    section.data[engine_.name] = data();
    if (!block_.tables.empty()) section.parts.push_back(std::move(block_));
  }

 private:
  const Values& values() const { return context_.values; }
  std::string engine_title(const std::string& title) const { return title + " (engine " + engine_.name + ")"; }

  const char* words() const {
    if (engine_.gpu) return "a graphics processor's program";
    return engine_.engine.tree == Engine::wide ? "vectors" : "the tree reconstructed from Table 4.2, in scalar code";
  }

  std::string method() const {
    if (engine_.gpu)
      return "The reference tree, or every sphere, in binary32, by a shader of GLSL ES 3.00. The text names \"the "
             "graphics "
             "hardware of the iPhone 5s\" as what limits the frames shown, and does not say in which language it "
             "traces.";
    if (engine_.engine.tree == Engine::wide)
      return "BF is brute force on vectors: as many rays as a vector has lanes, each tested against every sphere in "
             "binary64, with the bits of the scalar code; nothing is skipped by place, and a hit is known only after "
             "all "
             "spheres. \"BIH n\" is not the text's tree with two children a node, but this engine's: a tree of boxes, "
             "sixteen wide, whose leaves hold at most n spheres, walked by bundles of rays, with a filter in binary32. "
             "\"One leaf\" is that tree without any inner node: it keeps the bundles, the filter and the box around "
             "all "
             "spheres, so it is no brute force.";
    return "BF is a loop over all spheres for each ray. BIH n is the tree reconstructed from Table 4.2, with at most n "
           "spheres a "
           "leaf and two children a node. \"One leaf\" is the tree with MAX_PRIMS = n: the box around all, then all "
           "spheres.";
  }

  std::string gpu_name() const {
    for (const auto& [name, result] : context_.results)
      if (engine_.gpu && result.is_object() && result.contains(kGpu)) return result[kGpu].get<std::string>();
    return "";
  }

  // All configurations side by side on one scale, with what the text states as marks.
  void add_bars() {
    ChartData bars{fmt::format("Engine {}: frames per second", engine_.name),
                   "scenario: spheres",
                   "frames per second",
                   {},
                   {{"BF", {}}},
                   true};
    for (const std::int64_t prims : max_prims_) bars.series.push_back({tree_name(prims), {}});
    for (const auto& [key, times] : times_) {
      const std::size_t category = bars.categories.size();
      bars.categories.push_back(fmt::format("{}: {}", key.first, key.second));
      const auto add = [&](std::size_t series, const std::vector<double>& ms) {
        bars.series[series].values.emplace_back(fps_quartiles(ms).median);
        bars.series[series].spreads.emplace_back(spread_of_fps(ms));
      };
      add(0, times.brute);
      for (std::size_t i = 0; i < max_prims_.size(); ++i) add(i + 1, times.trees.at(max_prims_[i]));
      add_marks(bars, key, category);
    }
    bars.marks_name = "the text, iPhone 5s";
    add_illustration(
        "", bar_chart(bars),
        fmt::format("Engine {}: the median of the rounds, with quartiles as error bars, on one logarithmic "
                    "scale. Diamonds: the few frame rates that the text states, of its phone.",
                    engine_.name));
  }

  void add_marks(ChartData& bars, const std::pair<std::int64_t, std::int64_t>& key, std::size_t category) const {
    const std::string brute = fmt::format("brute.fps.spheres{}", key.second);
    if (values().has(brute))
      bars.marks.push_back({0, category, values().number(brute), fmt::format("the text, BF, {} spheres", key.second)});
    if (key.first != values().integer("best.scenario") || key.second != values().integer("best.spheres")) return;
    for (std::size_t i = 0; i < max_prims_.size(); ++i)
      if (max_prims_[i] == values().integer("best.max_prims"))
        bars.marks.push_back({i + 1, category, values().number("best.fps"), "the text, the best"});
  }

  // The curves over MAX_PRIMS, up to one leaf; all scenarios on one scale.
  void add_curves() {
    Series::Spread range{std::numeric_limits<double>::infinity(), 0};
    std::vector<std::int64_t> all = max_prims_;
    const auto reach = [&range](const std::vector<double>& ms) {
      range.low = std::min(range.low, fps_quartiles(ms).lower);
      range.high = std::max(range.high, fps_quartiles(ms).upper);
    };
    for (const auto& [key, times] : times_) {
      if (!engine_.gpu) reach(times.brute);
      for (const auto& [prims, ms] : times.trees) {
        reach(ms);
        if (prims != key.second && prims > all.back()) all.push_back(prims);
      }
    }
    for (const std::int64_t scenario : scenarios_) {
      ChartData curves{fmt::format("Scenario {}: over MAX_PRIMS, engine {}", scenario, engine_.name),
                       "MAX_PRIMS",
                       "frames per second",
                       {},
                       {},
                       true};
      curves.y_range = range;
      for (const std::int64_t prims : all) curves.categories.push_back(std::to_string(prims));
      if (!engine_.gpu) curves.categories.insert(curves.categories.end(), {"one leaf", "BF"});
      for (const std::int64_t count : counts_) {
        const auto found = times_.find({scenario, count});
        if (found == times_.end()) continue;
        Series curve{fmt::format("{} spheres", count), {}};
        const auto add = [&](const std::vector<double>* ms) {
          curve.values.push_back(ms != nullptr ? std::optional(fps_quartiles(*ms).median) : std::nullopt);
          curve.spreads.push_back(ms != nullptr ? std::optional(spread_of_fps(*ms)) : std::nullopt);
        };
        const auto tree = [&](std::int64_t prims) {
          const auto ms = found->second.trees.find(prims);
          return ms == found->second.trees.end() ? nullptr : &ms->second;
        };
        for (const std::int64_t prims : all) add(prims < count ? tree(prims) : nullptr);
        if (!engine_.gpu) {
          add(tree(count));
          add(&found->second.brute);
        }
        curves.series.push_back(std::move(curve));
      }
      if (curves.series.empty()) continue;
      add_illustration(fmt::format("-scenario{}-max_prims", scenario), line_chart(curves),
                       fmt::format("Scenario {} over MAX_PRIMS{}.", scenario,
                                   engine_.gpu ? "" : ", up to one leaf and brute force beside it"));
    }
  }

  void add_illustration(const std::string& name, const std::string& svg, const std::string& caption) {
    const std::string file = engine_.name + name + ".svg";
    if (const Status status = write_file(context_.folder + "/" + file, svg); !status) fail(status.error());
    block_.illustrations.push_back({"figure-4.4/" + file, caption});
  }

  Table frame_rates() const {
    std::vector<std::int64_t> all = max_prims_;
    for (const auto& [key, times] : times_)
      for (const auto& [prims, ms] : times.trees)
        if (prims != key.second && prims > all.back()) all.push_back(prims);
    Table table{engine_title("Frames per second"), {"Scenario", "Spheres", "Brute force"}, {}, ""};
    for (const std::int64_t prims : all) table.columns.push_back(tree_name(prims));
    if (!engine_.gpu) table.columns.emplace_back("One leaf");
    for (const auto& [key, times] : times_) {
      std::vector<Cell> row{{fmt::format("Scenario {}", key.first)}, {std::to_string(key.second)}};
      const auto add = [&row](const std::vector<double>& ms) {
        const Quartiles fps = fps_quartiles(ms);
        row.push_back(
            {fmt::format("{} ±{:.{}f}", fps_text(fps.median), (fps.upper - fps.lower) / 2, digits_of(fps.median))});
      };
      add(times.brute);
      for (const std::int64_t prims : all) {
        const auto found = times.trees.find(prims);
        if (found == times.trees.end() || prims >= key.second)
          row.push_back({""});
        else
          add(found->second);
      }
      if (const auto leaf = times.trees.find(key.second); leaf != times.trees.end())
        add(leaf->second);
      else if (!engine_.gpu)
        row.push_back({""});
      table.rows.push_back(std::move(row));
    }
    table.note =
        "Medians over the rounds, and half the distance between the quartiles. No verdicts: the thesis's bars stand in "
        "a "
        "picture that we do not have, and its machine was a phone.";
    if (!engine_.gpu) table.note += " One leaf: the tree with MAX_PRIMS = number of spheres.";
    return table;
  }

  void add_judgements(Section& section) {
    const std::vector<Judgement> judgements = judge_frame_rates(times_, values());
    for (const auto& [title, rule] : judgement_tables()) {
      Statements statements(engine_title(title), is_of_text(engine_) ? rule : rule + kOtherEngine);
      for (const Judgement& row : judgements) {
        if (row.table != title) continue;
        const ValueKind kind = is_of_text(engine_) ? row.expected.kind : ValueKind::inferred;
        statements.add(row.name, row.statement, {row.expected.text, kind}, row.ours, row.verdict, "", /*timed=*/true);
      }
      if (statements.empty()) continue;
      section.data["statements"].update({{engine_.name + ": " + title, statements.data()}});
      move(statements, section);
    }
  }

  // The findings stand in the experiment's list, the table in the block.
  void move(Statements& statements, Section& section) {
    statements.move_into(section, engine_.name + ".");
    block_.tables.push_back(std::move(section.tables.back()));
    section.tables.pop_back();
  }

  void add_independence(const Json& measured, Section& section) {
    Statements statements(
        engine_title("Brute force in the scenarios"),
        fmt::format(
            "Frames per second, measured apart from the tables above, the scenarios in turn. \"One place\": all "
            "spheres have their centre at the origin. Counts as the same if, of every two places, the quartiles of "
            "the ratio of their times stay within {:.0f} %, a limit that is ours; as different if those of two places "
            "lie wholly outside. A few per cent are to be expected: every ray makes the same tests everywhere, but a "
            "ray that hits something is shaded too, and how many hit differs from place to place.",
            100 * kStable));
    for (const std::int64_t count : counts_) {
      const Json& times = measured[fmt::format("spheres{}", count)]["frame_ms"];
      std::map<std::int64_t, std::vector<double>> by_place;
      for (const std::int64_t scenario : scenarios_)
        by_place[scenario] = times[fmt::format("scenario{}", scenario)].get<std::vector<double>>();
      add_dependence(statements, fmt::format("independence.spheres{}", count),
                     fmt::format("{} spheres: the fastest scenario is ahead of the slowest", count), by_place,
                     "brute.dependence_on_scenario");
      by_place[kOnePlace] = times[fmt::format("scenario{}", kOnePlace)].get<std::vector<double>>();
      add_dependence(statements, fmt::format("one_place.spheres{}", count),
                     fmt::format("{} spheres: the same with all of them at one place", count), by_place,
                     "one_place.dependence");
    }
    section.data["statements"].update({{engine_.name + ": brute force", statements.data()}});
    move(statements, section);
  }

  void add_dependence(Statements& statements, const std::string& name, const std::string& statement,
                      const std::map<std::int64_t, std::vector<double>>& by_place, const std::string& value) const {
    // Every two places in turn; the two that differ most are shown.
    std::vector<std::string> rates;
    rates.reserve(by_place.size());
    bool all_inside = true, one_outside = false;
    Quartiles most{1, 1, 1};
    for (const auto& [place, ms] : by_place)
      for (const auto& [other, other_ms] : by_place) {
        if (place == other) continue;
        const Quartiles ratio = times_as_fast(ms, other_ms);
        const Verdict inside = verdict_between(ratio, 1 / (1 + kStable), 1 + kStable);
        all_inside = all_inside && inside == Verdict::agrees;
        one_outside = one_outside || inside == Verdict::differs;
        if (ratio.median > most.median) most = ratio;
      }
    for (const auto& [place, ms] : by_place)
      rates.push_back(fmt::format("{} {} fps", place == kOnePlace ? "one place" : fmt::format("Scenario {}", place),
                                  fps_text(fps_quartiles(ms).median)));
    const bool depends = values().number(value) != 0;
    Verdict verdict = Verdict::undecided;
    if (all_inside) verdict = depends ? Verdict::differs : Verdict::agrees;
    if (one_outside) verdict = depends ? Verdict::agrees : Verdict::differs;
    statements.add(name, statement, {values().printed(value), ValueKind::inferred},
                   fmt::format("{} times: {}", quartiles_text(most, 3), fmt::join(rates, ", ")), verdict, "",
                   /*timed=*/true);
  }

  Json data() const {
    Json data = Json::object();
    for (const auto& [key, times] : times_) {
      Json trees = Json::object();
      for (const auto& [prims, ms] : times.trees) trees[std::to_string(prims)] = fps_quartiles(ms).median;
      data["configurations"].push_back(
          {{"scenario", key.first},
           {"spheres", key.second},
           {"brute_fps", fps_quartiles(times.brute).median},
           {"fps_by_max_prims", std::move(trees)},
           {"frame_ms", context_.results.at(configuration_step(engine_, key.first, key.second))}});
    }
    if (const auto found = context_.results.find(independence_step(engine_)); found != context_.results.end())
      data["brute_force_by_scenario"] = found->second;
    return data;
  }

  const SectionContext& context_;
  const ComparedEngine& engine_;
  std::vector<std::int64_t> scenarios_, counts_, max_prims_;
  EngineTimes times_;
  Section block_;
};

}  // namespace

EngineTimes times_of_steps(const SectionContext& context,
                           const std::function<std::string(std::int64_t scenario, std::int64_t spheres)>& step) {
  EngineTimes all;
  const std::string prefix = "max_prims";
  for (const std::int64_t scenario : context.values.integers("scenarios"))
    for (const std::int64_t spheres : context.values.integers("spheres_list")) {
      const auto found = context.results.find(step(scenario, spheres));
      if (found == context.results.end() || why_missing(found->second)) continue;
      ConfigurationTimes& times = all[{scenario, spheres}];
      for (const auto& [name, list] : found->second["frame_ms"].items())
        (name == "brute" ? times.brute : times.trees[std::stoll(name.substr(prefix.size()))]) =
            list.get<std::vector<double>>();
    }
  return all;
}

EngineTimes engine_times(const SectionContext& context, const ComparedEngine& engine) {
  return times_of_steps(context, [&](std::int64_t scenario, std::int64_t spheres) {
    return configuration_step(engine, scenario, spheres);
  });
}

void add_engines(const SectionContext& context, Section& section) {
  section.data["statements"] = Json::object();
  for (const ComparedEngine& engine : compared_engines()) EngineBlock(context, engine).add_to(section);
  // The reason why there was no graphics processor, from the first of its steps.
  for (const auto& [name, result] : context.results)
    if (const std::optional<std::string> why = why_missing(result)) {
      section.paragraphs.push_back("The engine gpu was not measured: " + *why + ".");
      return;
    }
}

}  // namespace bihive::cli::thesis
