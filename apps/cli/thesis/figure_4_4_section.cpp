// The section of Figure 4.4: charts, gains over brute force, and the thesis's statements compared with our
// measurements.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "bihive/base/write_file.h"
#include "bihive/image/svg_chart.h"
#include "bihive/thesis/frame_rates_report.h"
#include "support/failure.h"
#include "thesis/figure_4_4.h"

namespace bihive::cli::thesis {
namespace {

// Two frame rates closer than this count as equal in the shape of a curve. Frame rates of a machine with other work
// vary about as much.
constexpr double kWaver = 0.03;
// Brute force counts as equal in all scenarios if the fastest is ahead of the slowest by at most this.
constexpr double kStable = 0.10;
// A speed-up (1 + gain / 100) agrees within this factor, because processor and code are others.
constexpr double kSpeedUpFactor = 2;

Cell judged(const std::string& text, bool agrees) {
  return {text, agrees ? Verdict::agrees : Verdict::differs};
}

std::string fps_text(double fps) {
  return fps < 100 ? fmt::format("{:.2f}", fps) : fmt::format("{:.1f}", fps);
}

// The shape of a curve over MAX_PRIMS without steps within kWaver.
enum class Shape { rises, peaks, falls, other };

Shape shape_of(const std::vector<double>& curve) {
  const auto peak = std::max_element(curve.begin(), curve.end());
  for (auto at = curve.begin(); at + 1 < curve.end(); ++at) {
    const bool up = at[1] > at[0] * (1 + kWaver), down = at[1] < at[0] / (1 + kWaver);
    if ((at < peak && down) || (at >= peak && up)) return Shape::other;
  }
  // If the end is as good as the peak, the peak is at the end.
  const bool rose = *peak > curve.front() * (1 + kWaver), fell = *peak > curve.back() * (1 + kWaver);
  if (rose) return fell ? Shape::peaks : Shape::rises;
  return fell ? Shape::falls : Shape::other;
}

std::string shape_text(Shape shape) {
  switch (shape) {
    case Shape::rises:
      return "only rises";
    case Shape::peaks:
      return "rises, peaks, falls";
    case Shape::falls:
      return "only falls";
    case Shape::other:
      break;
  }
  return "up and down, or flat";
}

// One engine's part of the section.
class EngineSection {
 public:
  EngineSection(const SectionContext& context, const ComparedEngine& engine)
      : context_(context),
        engine_(engine),
        scenarios_(values().integers("scenarios")),
        counts_(values().integers("spheres_list")),
        max_prims_(values().integers("max_prims_list")) {
    for (const std::int64_t scenario : scenarios_)
      for (const std::int64_t spheres : counts_)
        if (std::optional<ConfigurationFps> fps = fps_of(context.results, engine, scenario, spheres))
          fps_.emplace(std::pair{scenario, spheres}, std::move(*fps));
  }

  void add_to(Section& section) const {
    if (!fps_.empty()) {
      section.tables.push_back(frame_rates());
      section.tables.push_back(gains());
      section.tables.push_back(winners());
      section.tables.push_back(shapes());
      section.tables.push_back(extremes());
      for (const std::int64_t scenario : scenarios_) add_charts(scenario, section);
    }
    if (const auto found = context_.results.find(independence_step(engine_));
        found != context_.results.end() && !why_missing(found->second))
      section.tables.push_back(independence(found->second));
    section.data[engine_.name] = data();
  }

 private:
  const Values& values() const { return context_.values; }
  bool complete() const { return fps_.size() == scenarios_.size() * counts_.size(); }
  std::string engine_title(const std::string& title) const { return title + " (engine " + engine_.name + ")"; }
  std::string name_of(std::size_t tree) const { return tree_name(max_prims_[tree]); }

  // Gains of one scenario, by number of spheres; empty if a configuration is missing.
  std::map<std::int64_t, double> gains_of(std::int64_t scenario) const {
    std::map<std::int64_t, double> gains;
    for (const std::int64_t spheres : counts_) {
      const auto found = fps_.find({scenario, spheres});
      if (found == fps_.end()) return {};
      gains[spheres] = found->second.gain_percent();
    }
    return gains;
  }
  static double mean(const std::map<std::int64_t, double>& gains) {
    double sum = 0;
    for (const auto& [spheres, gain] : gains) sum += gain;
    return sum / static_cast<double>(gains.size());
  }
  static bool less(const std::pair<const std::int64_t, double>& a, const std::pair<const std::int64_t, double>& b) {
    return a.second < b.second;
  }

  Table frame_rates() const {
    Table table{engine_title("Frames per second"), {"Scenario", "Spheres", "Brute force"}, {}, ""};
    for (std::size_t i = 0; i < max_prims_.size(); ++i) table.columns.push_back(name_of(i));
    table.columns.push_back("Gain of the best");
    for (const auto& [configuration, fps] : fps_) {
      std::vector<Cell> row{{fmt::format("Scenario {}", configuration.first)},
                            {std::to_string(configuration.second)},
                            {fps_text(fps.brute)}};
      for (const double tree : fps.trees) row.push_back({fps_text(tree)});
      row.push_back({fmt::format("{:+.0f} %", fps.gain_percent())});
      table.rows.push_back(std::move(row));
    }
    table.note = "Medians over the repetitions. No verdicts: the thesis's values stand in a picture without numbers.";
    return table;
  }

  // A stated gain beside ours and, if stated, its tree and its number of spheres.
  void add_gain(Table& table, const std::string& name, const std::string& what, double ours, std::int64_t scenario,
                std::int64_t spheres) const {
    const double ratio = (1 + ours / 100) / (1 + values().number(name) / 100);
    table.rows.push_back(
        {{what},
         {values().printed(name)},
         judged(fmt::format("{:+.0f} %", ours), ratio <= kSpeedUpFactor && ratio >= 1 / kSpeedUpFactor)});
    if (!values().has(name + ".max_prims")) return;
    const std::int64_t stated_tree = values().integer(name + ".max_prims"),
                       stated_count = values().integer(name + ".spheres");
    const std::size_t tree = fps_.at({scenario, spheres}).best();
    table.rows.push_back({{what + ": which"},
                          {fmt::format("BIH {}, {} spheres", stated_tree, stated_count)},
                          judged(fmt::format("{}, {} spheres", name_of(tree), spheres),
                                 max_prims_[tree] == stated_tree && spheres == stated_count)});
  }

  Table gains() const {
    Table table{engine_title("Gains over brute force"), {"Statement", "Thesis", "Ours"}, {}, ""};
    std::map<std::int64_t, double> means;
    for (const std::int64_t scenario : scenarios_) {
      const std::map<std::int64_t, double> gains = gains_of(scenario);
      if (gains.empty()) continue;
      means[scenario] = mean(gains);
      const std::string prefix = fmt::format("scenario{}.gain_percent", scenario),
                        name = fmt::format("Scenario {}", scenario);
      const auto most = std::max_element(gains.begin(), gains.end(), less);
      const auto least = std::min_element(gains.begin(), gains.end(), less);
      if (values().has(prefix + ".best"))
        add_gain(table, prefix + ".best", name + ", most", most->second, scenario, most->first);
      if (values().has(prefix + ".least"))
        add_gain(table, prefix + ".least", name + ", least", least->second, scenario, least->first);
      if (values().has(prefix + ".mean"))
        add_gain(table, prefix + ".mean", name + ", mean", means[scenario], scenario, least->first);
    }

    // Statements that need more than one scenario.
    if (means.size() == scenarios_.size()) {
      const auto best = std::max_element(means.begin(), means.end(), less);
      table.rows.push_back({{"the scenario with the highest mean"},
                            {fmt::format("Scenario {}", values().integer("most_advantageous.scenario"))},
                            judged(fmt::format("Scenario {} ({:+.0f} %)", best->first, best->second),
                                   best->first == values().integer("most_advantageous.scenario"))});
      const std::vector<double> pair = values().numbers("mean_exceeds_best.scenarios");
      const auto above = static_cast<std::int64_t>(pair.front()), below = static_cast<std::int64_t>(pair.back());
      const std::map<std::int64_t, double> others = gains_of(below);
      if (means.count(above) != 0 && !others.empty()) {
        const double most = std::max_element(others.begin(), others.end(), less)->second;
        table.rows.push_back({{fmt::format("the mean of Scenario {} beside the most of Scenario {}", above, below)},
                              {"higher"},
                              judged(fmt::format("{} ({:+.0f} % and {:+.0f} %)",
                                                 means[above] > most ? "higher" : "not higher", means[above], most),
                                     means[above] > most)});
      }
    }
    table.note = fmt::format(
        "The gain is the best tree's frame rate over brute force's, less 1. Percentages agree if the speed-ups (1 + "
        "gain / 100) are within a factor of {} of each other, since processor and program are others; which "
        "configuration it is, and which scenario is ahead, must be the same.",
        kSpeedUpFactor);
    return table;
  }

  Table winners() const {
    Table table{engine_title("Which MAX_PRIMS wins where"), {"Configuration", "Thesis", "Ours"}, {}, ""};
    std::map<std::int64_t, int> wins;
    for (const auto& [configuration, fps] : fps_) {
      std::vector<double> sorted = fps.trees;
      std::sort(sorted.rbegin(), sorted.rend());
      ++wins[max_prims_[fps.best()]];
      const std::string lead =
          sorted.size() > 1 ? fmt::format(", {:.1f} % ahead of the second", 100 * (sorted[0] / sorted[1] - 1)) : "";
      table.rows.push_back({{fmt::format("Scenario {}, {} spheres", configuration.first, configuration.second)},
                            {""},
                            {name_of(fps.best()) + lead}});
    }
    if (complete()) {
      const std::int64_t winner = values().integer("winner.max_prims"), stated = values().integer("winner.wins");
      table.rows.push_back({{fmt::format("BIH {} is the best", winner)},
                            {fmt::format("in {} of {}", stated, values().integer("winner.configurations"))},
                            judged(fmt::format("in {} of {}", wins[winner], fps_.size()),
                                   wins[winner] == stated && static_cast<std::int64_t>(fps_.size()) ==
                                                                 values().integer("winner.configurations"))});
    }
    table.note =
        "Agrees only if the number of wins is the same. Which tree wins depends on how much a step down the tree costs "
        "beside a test of a sphere, which is the machine's and the program's.";
    return table;
  }

  Table shapes() const {
    Table table{engine_title("The curve over MAX_PRIMS"), {"Statement", "Thesis", "Ours", "Frames per second"}, {}, ""};
    for (const auto& [configuration, fps] : fps_) {
      const bool only_rises = configuration.first == values().integer("only_rises.scenario") &&
                              configuration.second == values().integer("only_rises.spheres");
      const Shape stated = only_rises ? Shape::rises : Shape::peaks, ours = shape_of(fps.trees);
      std::string curve;
      for (const double tree : fps.trees) curve += (curve.empty() ? "" : " ") + fmt::format("{:.1f}", tree);
      table.rows.push_back({{fmt::format("Scenario {}, {} spheres", configuration.first, configuration.second)},
                            {shape_text(stated)},
                            judged(shape_text(ours), ours == stated),
                            {curve}});
    }
    table.note = fmt::format(
        "From the smallest MAX_PRIMS to the largest. Steps of less than {:.0f} % are taken for none.", 100 * kWaver);
    return table;
  }

  Table extremes() const {
    Table table{engine_title("The best, the worst, and absolute values"), {"Statement", "Thesis", "Ours"}, {}, ""};
    if (complete()) {
      // The best tree of all, and the slowest of all.
      const auto best = std::max_element(fps_.begin(), fps_.end(), [](const auto& a, const auto& b) {
        return a.second.trees[a.second.best()] < b.second.trees[b.second.best()];
      });
      const auto is = [&](const std::string& name) {
        return best->first == std::pair{values().integer(name + ".scenario"), values().integer(name + ".spheres")} &&
               max_prims_[best->second.best()] == values().integer(name + ".max_prims");
      };
      const auto named = [&](const std::string& name) {
        return fmt::format("BIH {}, {} spheres, Scenario {}", values().integer(name + ".max_prims"),
                           values().integer(name + ".spheres"), values().integer(name + ".scenario"));
      };
      table.rows.push_back({{"best"},
                            {named("best") + "; without the display's limit perhaps " + named("supposed_best")},
                            judged(fmt::format("{}, {} spheres, Scenario {}", name_of(best->second.best()),
                                               best->first.second, best->first.first),
                                   is("best") || is("supposed_best"))});
      std::string slowest;
      std::int64_t slowest_spheres = 0;
      double lowest = std::numeric_limits<double>::infinity();
      for (const auto& [configuration, fps] : fps_)
        for (std::size_t i = 0; i <= fps.trees.size(); ++i) {
          const double value = i == 0 ? fps.brute : fps.trees[i - 1];
          if (value >= lowest) continue;
          lowest = value;
          slowest = i == 0 ? "BF" : name_of(i - 1);
          slowest_spheres = configuration.second;
        }
      table.rows.push_back({{"worst"},
                            {fmt::format("BF, {} spheres", values().integer("worst.spheres"))},
                            judged(fmt::format("{}, {} spheres", slowest, slowest_spheres),
                                   slowest == "BF" && slowest_spheres == values().integer("worst.spheres"))});
      table.rows.push_back({{"fps of the best"},
                            {values().printed("best.fps") + ", the display's limit"},
                            {fps_text(best->second.trees[best->second.best()])}});
    }
    for (const std::int64_t spheres : counts_) {
      const std::string name = fmt::format("brute.fps.spheres{}", spheres);
      const auto found = fps_.find({scenarios_.front(), spheres});
      if (values().has(name) && found != fps_.end())
        table.rows.push_back({{fmt::format("fps of brute force, {} spheres", spheres)},
                              {values().printed(name)},
                              {fps_text(found->second.brute)}});
    }
    table.note =
        fmt::format("No verdicts on absolute values: those of brute force are for Scenario {}.", scenarios_.front());
    return table;
  }

  Table independence(const Json& measured) const {
    Table table{engine_title("Brute force in the scenarios"), {"Spheres"}, {}, ""};
    for (const std::int64_t scenario : scenarios_) table.columns.push_back(fmt::format("Scenario {}", scenario));
    table.columns.insert(table.columns.end(), {"Fastest / slowest", "Thesis"});
    const bool stated = values().number("brute.dependence_on_scenario") != 0;
    for (const std::int64_t spheres : counts_) {
      std::vector<Cell> row{{std::to_string(spheres)}};
      double fastest = 0, slowest = std::numeric_limits<double>::infinity();
      for (const auto& [name, times] : measured[fmt::format("spheres{}", spheres)]["frame_ms"].items()) {
        const auto ms = times.get<std::vector<double>>();
        const double fps = 1000 / *std::min_element(ms.begin(), ms.end());
        fastest = std::max(fastest, fps);
        slowest = std::min(slowest, fps);
        row.push_back({fps_text(fps)});
      }
      const bool depends = fastest > slowest * (1 + kStable);
      row.push_back(judged(fmt::format("{:.3f}", fastest / slowest), depends == stated));
      row.push_back({values().printed("brute.dependence_on_scenario")});
      table.rows.push_back(std::move(row));
    }
    table.note = fmt::format(
        "Frames per second, measured apart from the table above, the scenarios in turn; of each the fastest round, "
        "which other work of the machine disturbs least. Taken for the same if the fastest is at most {:.0f} % ahead.",
        100 * kStable);
    return table;
  }

  void add_charts(std::int64_t scenario, Section& section) const {
    const auto measured = [&](std::int64_t spheres) -> const ConfigurationFps* {
      const auto found = fps_.find({scenario, spheres});
      return found == fps_.end() ? nullptr : &found->second;
    };
    const ChartData bars = frame_rate_bars(scenario, counts_, max_prims_, measured);
    // And a chart over MAX_PRIMS, which shows the curve.
    ChartData curves{
        fmt::format("Scenario {}: over MAX_PRIMS", scenario), "MAX_PRIMS", "frames per second", {}, {}, false};
    for (const std::int64_t max_prims : max_prims_) curves.categories.push_back(std::to_string(max_prims));
    for (const std::int64_t spheres : counts_) {
      const ConfigurationFps* const found = measured(spheres);
      Series curve{fmt::format("{} spheres", spheres), {}};
      for (std::size_t i = 0; i < max_prims_.size(); ++i)
        curve.values.push_back(found != nullptr ? std::optional(found->trees[i]) : std::nullopt);
      curves.series.push_back(std::move(curve));
    }
    const std::string experiment = "figure-4.4";
    const auto add = [&](const std::string& name, const std::string& svg, const std::string& caption) {
      const std::string file = fmt::format("{}-scenario{}{}.svg", engine_.name, scenario, name);
      if (const Status status = write_file(context_.folder + "/" + file, svg); !status) fail(status.error());
      section.illustrations.push_back({experiment + "/" + file, caption});
    };
    add("", bar_chart(bars), fmt::format("Scenario {} on the engine {}: frames per second.", scenario, engine_.name));
    add("-max_prims", line_chart(curves),
        fmt::format("The same over MAX_PRIMS: Scenario {} on the engine {}.", scenario, engine_.name));
  }

  Json data() const {
    Json data = Json::object();
    for (const auto& [configuration, fps] : fps_) {
      Json trees = Json::object();
      for (std::size_t i = 0; i < max_prims_.size(); ++i) trees[std::to_string(max_prims_[i])] = fps.trees[i];
      data["configurations"].push_back(
          {{"scenario", configuration.first},
           {"spheres", configuration.second},
           {"brute_fps", fps.brute},
           {"fps_by_max_prims", std::move(trees)},
           {"gain_percent", fps.gain_percent()},
           {"frame_ms", context_.results.at(configuration_step(engine_, configuration.first, configuration.second))}});
    }
    if (const auto found = context_.results.find(independence_step(engine_)); found != context_.results.end())
      data["brute_force_by_scenario"] = found->second;
    return data;
  }

  const SectionContext& context_;
  const ComparedEngine& engine_;
  std::vector<std::int64_t> scenarios_, counts_, max_prims_;
  std::map<std::pair<std::int64_t, std::int64_t>, ConfigurationFps> fps_;
};

// The name of the graphics processor, or the reason why there was none, from the first of its steps.
void add_gpu(const SectionContext& context, Section& section) {
  for (const auto& [name, result] : context.results) {
    if (const std::optional<std::string> why = why_missing(result)) {
      section.paragraphs.push_back("The engine gpu was not measured: " + *why + ".");
      return;
    }
    if (!result.contains(kGpu)) continue;
    section.paragraphs.push_back(
        "The engine gpu is the same renderer as a shader of OpenGL ES 3, as in the thesis: the reference tree, or "
        "every "
        "sphere, in binary32. Here it ran on: " +
        result[kGpu].get<std::string>() +
        ". Where that names llvmpipe or SwiftShader, the processor's own cores stood in for a graphics processor.");
    return;
  }
}

}  // namespace

Section figure_4_4_section(const SectionContext& context) {
  Section section;
  section.pairs = true;
  section.paragraphs.push_back(
      "Each configuration draws the same picture: primary rays only, the same shading, no shadows, so that only the "
      "search for the first hit differs. BF tests every sphere; BIH n is a tree with at most n spheres a leaf. Brute "
      "force and all trees of a configuration take turns, round by round; the first round does not count, and the "
      "median of the others does. A frame has a cost that no tree takes away: making the rays, shading what they "
      "hit, writing the picture.");
  for (const auto& [name, result] : context.results)
    if (result.contains("width_px")) {
      section.paragraphs.push_back(fmt::format(
          "The picture has {} x {} pixels{}.", result["width_px"].get<int>(), result["height_px"].get<int>(),
          context.settings.quick ? fmt::format(" in this quick run, where the full run has {} x {}",
                                               context.values.integer("width_px"), context.values.integer("height_px"))
                                 : ""));
      break;
    }
  for (const ComparedEngine& engine : compared_engines()) EngineSection(context, engine).add_to(section);
  add_gpu(context, section);
  return section;
}

}  // namespace bihive::cli::thesis
