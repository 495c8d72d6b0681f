// Figure 4.4: the costs of inner nodes, leaves and sphere tests at which the text's claims hold, and the costs here.
// The work of the rays is counted; clocks give costs, and costs are points in a diagram.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "bihive/base/write_file.h"
#include "bihive/thesis/cost_diagram.h"
#include "bihive/thesis/frame_rates_report.h"
#include "claims.h"
#include "figure_4_4.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// A quick run counts the rays of every kQuickStride-th row and column. Other seeds and variations are counted more
// coarsely.
constexpr int kQuickStride = 4, kOtherStride = 4, kQuickOtherStride = 8;
constexpr std::uint64_t kSeeds = 60, kQuickSeeds = 5;
// Rows of the table: a leaf in inner nodes.
constexpr double kLeafCosts[] = {0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 1};
// Costs at which the claims are tested: of an inner node, across the range in which the pattern holds; the fixed part.
constexpr int kTries = 21;
constexpr double kFixedCosts[] = {0, 0.5, 1, 1.5, 2, 3};

// The names of steps.
std::string step_of(const std::string& what, std::int64_t scenario) {
  return fmt::format("{}-scenario{}", what, scenario);
}
std::string step_of(const TimedProgram& program, Configuration of) {
  return fmt::format("{}-scenario{}-spheres{}", program.key, of.first, of.second);
}

// Rows of values.json: an assumption on which the results depend, and to what it is changed to see how much. The first
// changes nothing.
Json variations(const Experiment& experiment) {
  static const std::set<std::string> known{"key",       "what",    "usual",  "other",       "width_px",
                                           "height_px", "fov_deg", "radius", "corner_side", "counting"};
  Json rows = experiment.values.document().value("variations", Json::array());
  for (const Json& row : rows)
    for (const auto& [key, value] : row.items())
      if (!known.contains(key)) fail({"/variations: there is no \"" + key + "\" to vary", "values.json", 0, 0, ""});
  return rows;
}

Counting counting_of(const Json& variation) {
  const std::string name = variation.value("counting", "each_ray");
  for (const auto& [known, counting] : {std::pair{"each_ray", Counting::each_ray},
                                        {"without_culling", Counting::without_culling},
                                        {"lockstep_by_node", Counting::lockstep_by_node},
                                        {"lockstep_by_leaf", Counting::lockstep_by_leaf}})
    if (name == known) return counting;
  fail({"/variations: there is no counting \"" + name + "\"", "values.json", 0, 0, ""});
}

// [{"scenario", "spheres", "max_prims", "inner", "leaves", "tests"}], or null if cancelled.
Json count_rays(const Experiment& experiment, const FrameRatePlan& plan, int stride, Counting counting) {
  const Result<FigureWork> work = counted_figure(plan, stride, &experiment.cancel, counting);
  if (experiment.cancel.cancelled()) return {};
  Json rows = Json::array();
  for (const auto& [configuration, trees] : value_or_fail(work))
    for (const auto& [max_prims, one] : trees)
      rows.push_back({{"scenario", configuration.first},
                      {"spheres", configuration.second},
                      {"max_prims", max_prims},
                      {"inner", one.inner},
                      {"leaves", one.leaves},
                      {"tests", one.tests}});
  return rows;
}

void add_work(const Json& rows, FigureWork& work) {
  for (const Json& row : rows)
    work[{row["scenario"], row["spheres"]}][row["max_prims"]] = {row["inner"], row["leaves"], row["tests"]};
}

// The text's trees of a scenario, and trees of larger leaves, up to one leaf.
Json count_scenario(const Experiment& experiment, std::int64_t scenario) {
  FrameRatePlan plan = plan_of(experiment);
  plan.scenarios = {scenario};
  for (const std::int64_t more : experiment.values.integers("max_prims_beyond")) plan.max_prims.push_back(more);
  plan.max_prims.push_back(kUnlimited);
  return count_rays(experiment, plan, experiment.settings.quick ? kQuickStride : 1, Counting::each_ray);
}

// The rows of each seed 1, 2, ...; a scenario without random numbers has one.
Json count_variation(const Experiment& experiment, const Json& variation, std::int64_t scenario) {
  FrameRatePlan plan = plan_of(experiment);
  plan.scenarios = {scenario};
  plan.width_px = variation.value("width_px", plan.width_px);
  plan.height_px = variation.value("height_px", plan.height_px);
  plan.fov_deg = variation.value("fov_deg", plan.fov_deg);
  plan.radius = variation.value("radius", plan.radius);
  plan.corner_side = variation.value("corner_side", plan.corner_side);
  const bool quick = experiment.settings.quick;
  const std::uint64_t seeds = scenario_of(scenario) == Scenario::grid ? 1 : quick ? kQuickSeeds : kSeeds;
  Json all = Json::array();
  for (plan.seed = 1; plan.seed <= seeds; ++plan.seed)
    all.push_back(count_rays(experiment, plan, quick ? kQuickOtherStride : kOtherStride, counting_of(variation)));
  return all;
}

std::string ranges_text(const std::vector<CostRange>& ranges) {
  std::string text;
  for (const CostRange& range : ranges)
    text += (text.empty() ? "" : " or ") + (std::isinf(range.high)
                                                ? fmt::format("{:.2f} or more", range.low)
                                                : fmt::format("{:.2f} to {:.2f}", range.low, range.high));
  return text.empty() ? "nowhere" : text;
}

std::string costs_text(const StepCosts& costs) {
  return fmt::format("{:.2f} sphere tests for an inner node, {:.3g} inner nodes for a leaf and {:.3g} tests for a ray",
                     costs.inner, costs.leaf, costs.fixed);
}

class FigureData {
 public:
  explicit FigureData(const Experiment& experiment)
      : experiment_(experiment),
        values_(experiment.values),
        plan_(plan_of(experiment)),
        pattern_(value_or_fail(stated_pattern(values_.stated()))) {
    for (const std::int64_t scenario : plan_.scenarios)
      if (const Json* const rows = experiment.result(step_of("counts", scenario))) {
        add_work(*rows, work_);
        for (const Json& row : *rows) data_["counts"].push_back(row);
      }
  }

  Json all() {
    if (work_.size() == plan_.scenarios.size() * plan_.spheres.size()) {
      seeds_ = figures_of("seeds");
      data_["seeds"] = seeds_.size();
      for (const TimedProgram& program : timed_programs()) fit(program);
      add_diagram();
      add_leaf_costs();
      add_variations();
      add_claims();
    }
    if (const Json* const times = experiment_.result("brute_force")) add_brute_force(*times);
    if (const Json* const rows = experiment_.result("balance")) add_balance(*rows);
    add_lost_bars();
    return std::move(data_);
  }

 private:
  // A variation's figure with each seed that was counted; none if a step is missing.
  std::vector<FigureWork> figures_of(const std::string& variation) const {
    std::vector<const Json*> scenarios;
    std::size_t seeds = 0;
    for (const std::int64_t scenario : plan_.scenarios) {
      scenarios.push_back(experiment_.result(step_of(variation, scenario)));
      if (scenarios.back() == nullptr) return {};
      seeds = std::max(seeds, scenarios.back()->size());
    }
    std::vector<FigureWork> figures(seeds);
    for (const Json* const of_seeds : scenarios)
      for (std::size_t seed = 0; seed < seeds; ++seed)
        add_work((*of_seeds)[std::min(seed, of_seeds->size() - 1)], figures[seed]);
    return figures;
  }

  // With how many of the seeds the pattern holds somewhere.
  std::int64_t with_pattern(const std::vector<FigureWork>& seeds, double leaf) const {
    return std::count_if(seeds.begin(), seeds.end(),
                         [&](const FigureWork& seed) { return !wins_by_cost(seed, pattern_, leaf).pattern.empty(); });
  }

  // Rates and costs from a program's own times.
  void fit(const TimedProgram& program) {
    EngineTimes times;
    Json last;
    std::int64_t differ = data_.value("pixels_that_differ", 0);
    for (const auto& [configuration, trees] : work_) {
      const Json* const result = experiment_.result(step_of(program, configuration));
      if (result == nullptr) return;
      last = *result;
      if (last.contains("missing")) data_["missing_shader"] = last["missing"];
      if (last.contains("missing")) return;
      times[configuration] = times_of(last);
      differ = std::max(differ, last.value("pixels_that_differ", std::int64_t{0}));
    }
    data_["pixels_that_differ"] = differ;
    add_rates(program, times);
    const int threads = experiment_.settings.threads > 0 ? experiment_.settings.threads : hardware_threads();
    const double pixels = last["width_px"].get<double>() * last["height_px"].get<double>();
    const double ns_per_ms = 1e6 / pixels * (std::string(program.key) == "reference" ? threads : 1);
    const FittedCosts fitted = fit_costs(work_, times, ns_per_ms);
    if (fitted.frames == 0) return;
    // Software that emulates a GPU is not one.
    const std::string gpu = last.value("gpu", "");
    const bool software = is_software(gpu);
    const std::string name = program.name + std::string(software ? " in software, no graphics processor" : "");
    Json row{{"key", program.key},
             {"name", name},
             {"gpu", gpu},
             {"software", software},
             {"determined", fitted.determined()},
             {"inner_words", fitted.words().inner},
             {"leaf_words", fitted.words().leaf},
             {"rms_percent", 100 * fitted.rms},
             {"frames", fitted.frames},
             {"wins", wins_of(work_, pattern_, fitted.costs())}};
    for (const auto& [cost, value] : fitted.named()) row[cost] = value;
    if (!gpu.empty()) row["one_sphere_ms"] = median(last.at("one_sphere_ms").get<std::vector<double>>());
    if (fitted.determined()) data_["rates"].back()["costs"] = costs_text(fitted.costs());
    data_["fits"].push_back(std::move(row));
    if (fitted.determined()) fits_.push_back({program.key, name, fitted, software});
  }

  // Frames per second, without verdicts, and the thesis program's as charts like the text's.
  void add_rates(const TimedProgram& program, const EngineTimes& times) {
    Json rows = Json::array();
    for (const auto& [configuration, one] : times) {
      Json& row = rows.emplace_back(Json{{"scenario", configuration.first},
                                         {"spheres", configuration.second},
                                         {"brute_fps", frames_per_second(one.brute)},
                                         {"gain_percent", one.gain_percent()}});
      for (const auto& [prims, ms] : one.trees)
        row["trees"].push_back({{"tree", tree_name(prims)}, {"fps", frames_per_second(ms)}});
    }
    data_["rates"].push_back(
        {{"key", program.key}, {"trees", plan_.max_prims}, {"rows", std::move(rows)}, {"name", program.name}});
    if (&program != &timed_programs().front()) return;
    for (const std::int64_t scenario : plan_.scenarios)
      write(fmt::format("scenario{}.svg", scenario),
            bar_chart(frame_rate_bars(scenario, plan_.spheres, plan_.max_prims, times)));
  }

  void add_diagram() const {
    CostDiagram diagram = cost_diagram(work_, pattern_, seeds_);
    for (const auto& [key, name, fitted, software] : fits_)
      diagram.points.push_back({name.substr(0, name.find(',')), fitted});
    write("costs.svg", cost_diagram_svg(diagram));
    write("costs.csv", cost_diagram_csv(diagram));
    const Json numbers = {{"inner_node_per_sphere_test", diagram.inner},
                          {"leaf_per_inner_node", diagram.leaf},
                          {"wins", diagram.wins},
                          {"pattern", diagram.pattern},
                          {"share_of_seeds", diagram.share}};
    write("costs.json", numbers.dump() + "\n");
  }

  void write(const std::string& file, const std::string& text) const {
    value_or_fail(write_file(experiment_.folder + "/" + file, text));
  }

  void add_leaf_costs() {
    Json fails;  // the first of the largest costs of a leaf, at which the pattern holds nowhere
    for (const double leaf : kLeafCosts) {
      const WinsByCost found = wins_by_cost(work_, pattern_, leaf);
      if (!found.pattern.empty())
        fails = nullptr;
      else if (fails.is_null())
        fails = {{"leaf", leaf}, {"most", found.most}};
      Json ranges = Json::array();
      for (const CostRange& range : found.pattern)
        ranges.push_back({range.low, std::isinf(range.high) ? Json() : Json(range.high)});
      data_["leaf_costs"].push_back({{"leaf", leaf},
                                     {"most_wins", found.most},
                                     {"stated_text", ranges_text(found.stated)},
                                     {"pattern_text", ranges_text(found.pattern)},
                                     {"pattern", std::move(ranges)},
                                     {"seeds_with", with_pattern(seeds_, leaf)}});
    }
    const WinsByCost free = wins_by_cost(work_, pattern_, 0);
    const bool same_number = static_cast<std::int64_t>(work_.size()) == values_.integer("winner.configurations");
    data_["possible"] = {{"wins", same_number && !free.stated.empty() ? pattern_.wins : free.most},
                         {"where", ranges_text(free.stated)},
                         {"pattern", ranges_text(free.pattern)},
                         {"most", free.most},
                         {"fails", fails}};
  }

  void add_variations() {
    for (Json row : variations(experiment_)) {
      const std::vector<FigureWork> seeds = figures_of(row["key"]);
      if (seeds.empty()) continue;
      const WinsByCost first = wins_by_cost(seeds.front(), pattern_, 0);
      row.update({{"most_wins", first.most},
                  {"pattern_text", ranges_text(first.pattern)},
                  {"seeds_with", with_pattern(seeds, 0)},
                  {"seeds", seeds.size()}});
      data_["variations"].push_back(std::move(row));
    }
  }

  Json findings_at(const Json& quantities) const { return judge(values_, {{"at", {{"text", quantities}}}}); }
  static std::int64_t agreeing(const Json& findings) {
    return std::count_if(findings.begin(), findings.end(),
                         [](const Json& each) { return each["verdict"] == "agrees"; });
  }

  // The largest factor between the speed-ups that the text states and those at these costs.
  double gain_factor(const Json& quantities) const {
    double most = 1;
    for (const auto& [scenario, gains] : quantities["gain"].items())
      for (const auto& [ours, name] : {std::pair{"most", "best"}, {"least", "least"}, {"mean", "mean"}})
        if (const std::string stated = scenario + ".gain_percent." + name; values_.has(stated)) {
          const double ratio = (100 + gains[ours].get<double>()) / (100 + values_.number(stated));
          most = std::max({most, ratio, 1 / ratio});
        }
    return most;
  }

  // The asked costs; else, of those that are tried, the costs within the pattern that suit most of the text's claims;
  // of equal ones those whose gains are the nearest.
  std::optional<StepCosts> chosen_costs() const {
    const std::vector<double>& asked = experiment_.settings.costs;
    if (asked.size() == 3) return StepCosts{asked[0], asked[1], asked[2]};
    std::optional<StepCosts> best;
    std::pair<std::int64_t, double> most{-1, 0};
    for (const CostRange& range : wins_by_cost(work_, pattern_, 0).pattern)
      for (int i = 0; i < kTries && std::isfinite(range.high); ++i)
        for (const double fixed : kFixedCosts) {
          const StepCosts costs{range.low + (range.high - range.low) * (i + 0.5) / kTries, 0, fixed};
          const Json at = quantities_at(work_, pattern_, costs, values_);
          const std::pair suits{agreeing(findings_at(at)), -gain_factor(at)};
          if (suits <= most) continue;
          best = costs;
          most = suits;
        }
    return best;
  }

  // All claims about frame rates at the chosen costs, and beside them at those of each program.
  void add_claims() {
    const std::optional<StepCosts> costs = chosen_costs();
    if (!costs) return;
    data_["at"]["text"] = quantities_at(work_, pattern_, *costs, values_);
    const Json findings = findings_at(data_["at"]["text"]);
    Json programs = Json::array(), rows = findings;
    for (Json& row : rows) {
      row.update(words_of(row));
      row["elsewhere"] = Json::array();
    }
    for (const auto& [key, name, fitted, software] : fits_) {
      if (software) continue;  // no verdict
      programs.push_back({{"name", name}, {"costs", costs_text(fitted.costs())}});
      data_["at"][key] = quantities_at(work_, pattern_, fitted.costs(), values_);
      const Json there = findings_at(data_["at"][key]);
      for (std::size_t i = 0; i < there.size(); ++i)
        rows[i]["elsewhere"].push_back({{"program", name}, {"ours", there[i]["ours"]}});
    }
    data_["claims_at_costs"] = {{"inner", costs->inner},           {"leaf", costs->leaf},
                                {"fixed", costs->fixed},           {"asked", !experiment_.settings.costs.empty()},
                                {"where", costs_text(*costs)},     {"gain_factor", gain_factor(data_["at"]["text"])},
                                {"agree", agreeing(findings)},     {"all", rows.size()},
                                {"programs", std::move(programs)}, {"rows", std::move(rows)}};
  }

  // Brute force in the scenarios and with all spheres at one position: the slowest over the fastest.
  void add_brute_force(const Json& result) {
    double most = 0, most_with_one_place = 0;
    const auto spread = [](const Json& ms) {
      const auto [least, greatest] = std::minmax_element(ms.begin(), ms.end());
      return greatest->get<double>() / least->get<double>();
    };
    for (Json times : result) {
      most_with_one_place = std::max(most_with_one_place, spread(times));
      times.erase("one_place");
      most = std::max(most, spread(times));
    }
    data_["brute_force"] = {{"scenarios_ratio", most}, {"one_place_ratio", most_with_one_place}, {"ms", result}};
  }

  // The text's reasons for Scenario 3: how much the leaves of the scenarios deviate.
  void add_balance(const Json& rows) {
    data_["balance"] = rows;
    for (const Json& row : rows)
      for (const auto& [name, of] : {std::pair{"deviation", "spheres_per_leaf_sd"}, {"imbalance", "depth_sd"}})
        data_[name]["spheres" + row["spheres"].dump()][row["scenario"].dump()] = row[of];
  }

  // The values of the lost bars, by arithmetic on the text's own numbers.
  void add_lost_bars() {
    const auto number = [this](const char* name) { return values_.number(name); };
    const double most = number("scenario2.gain_percent.best"), least = number("scenario2.gain_percent.least");
    const double third = 3 * number("scenario2.gain_percent.mean") - most - least, cap = number("display.fps");
    const double bf128 = number("brute.fps.spheres128"), bf256 = number("brute.fps.spheres256");
    const double bf64 = cap / (1 + least / 100), most3 = 1 + number("scenario3.gain_percent.best") / 100;
    data_["lost_bars"] = {{"third_gain_percent", third},
                          {"best128_fps", bf128 * (1 + most / 100)},
                          {"best256_fps", bf256 * (1 + third / 100)},
                          {"brute64_fps_at_most", bf64},
                          {"scenario3_most64_fps", bf64 * most3},
                          {"scenario3_most128_fps", bf128 * most3},
                          {"scenario3_most256_fps", bf256 * most3},
                          {"fall_64_to_128", bf64 / bf128},
                          {"fall_128_to_256", bf128 / bf256}};
  }

  struct Fit {
    std::string key, name;
    FittedCosts costs;
    bool software;
  };

  const Experiment& experiment_;
  const Values& values_;
  const FrameRatePlan plan_;
  const WinPattern pattern_;
  FigureWork work_;
  std::vector<FigureWork> seeds_;
  std::vector<Fit> fits_;
  Json data_ = Json::object();
};

}  // namespace

void figure_4_4(Experiment& experiment) {
  const FrameRatePlan plan = plan_of(experiment);
  for (const std::int64_t scenario : plan.scenarios) {
    experiment.add(step_of("counts", scenario), 0.5, 8, count_scenario, scenario);
    for (const Json& variation : variations(experiment))
      experiment.add(step_of(variation["key"], scenario), 0.1, 3, count_variation, variation, scenario);
  }
  experiment.add("balance", 0.3, 0.3, [](const Experiment& of) {
    return measure_reasons(of, of.values.integers("spheres_list"), {of.values.integer("winner.max_prims")},
                           of.settings.quick ? 10 : 100);
  });
  for (const TimedProgram& program : timed_programs())
    for (const std::int64_t scenario : plan.scenarios)
      for (const std::int64_t spheres : plan.spheres)
        experiment.add(step_of(program, {scenario, spheres}), program.weight / 20, program.weight, program.measure,
                       scenario, spheres);
  experiment.add("brute_force", 1, 1, measure_brute_force);
  experiment.make_data = [](const Experiment& measured) { return FigureData(measured).all(); };
}

}  // namespace bihive::thesis
