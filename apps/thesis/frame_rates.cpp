// Figure 4.4: at which costs of inner nodes, leaves and sphere tests do the text's claims hold, and what do they cost
// here? The work of the rays is counted without a clock; clocks give costs, and costs are points in a diagram.
#include "bihive/thesis/frame_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "bihive/thesis/figure_costs.h"
#include "bihive/thesis/frame_rates_report.h"
#include "claims.h"
#include "claims_at_costs.h"
#include "frame_times.h"
#include "statistics.h"
#include "tree_reasons.h"

namespace bihive::thesis {
namespace {

constexpr const char *kBalanceStep = "balance", *kBruteForceStep = "brute_force";
// A quick run counts the rays of every kQuickStride-th row and column. Other seeds and variations of the picture are
// counted more coarsely.
constexpr int kQuickStride = 4, kOtherStride = 4, kQuickOtherStride = 8;
constexpr std::uint64_t kSeeds = 60, kQuickSeeds = 5;
// Rows of the table: a leaf in inner nodes.
constexpr double kLeafCosts[] = {0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 1};
// Costs of an inner node at which the claims are tried, across the range in which the pattern holds.
constexpr int kTries = 41;

std::string counts_step(std::int64_t scenario) {
  return fmt::format("counts-scenario{}", scenario);
}
std::string seeds_step(std::int64_t scenario) {
  return fmt::format("seeds-scenario{}", scenario);
}
std::string times_step(const TimedProgram& program, std::int64_t scenario, std::int64_t spheres) {
  return fmt::format("{}-scenario{}-spheres{}", program.key, scenario, spheres);
}

// What the results depend on, and to what it is changed to see how much.
struct Variation {
  const char *key, *what, *usual, *other;
  void (*change)(FrameRatePlan&);
};
const std::vector<Variation>& variations() {
  static const std::vector<Variation> kAll{
      {"square", "The picture's format", "1136 x 640", "640 x 640",
       [](FrameRatePlan& plan) { plan.width_px = plan.height_px; }},
      {"portrait", "The picture's format", "1136 x 640", "640 x 1136",
       [](FrameRatePlan& plan) { std::swap(plan.width_px, plan.height_px); }},
      {"near", "The angle along the shorter side", "30 degrees", "27.8 degrees",
       [](FrameRatePlan& plan) { plan.fov_deg = 27.8; }},
      {"small", "The spheres' radius", "1", "0.5", [](FrameRatePlan& plan) { plan.radius = 0.5; }},
      {"large", "The spheres' radius", "1", "2", [](FrameRatePlan& plan) { plan.radius = 2; }}};
  return kAll;
}

// The plan of the rays that a step counts, in one scenario or in all.
FrameRatePlan plan_of(const StepContext& context, std::optional<std::int64_t> scenario) {
  FrameRatePlan plan = cli::value_or_fail(FrameRatePlan::from_values(context.values.stated()));
  if (scenario) plan.scenarios = {*scenario};
  plan.seed = context.settings.seed;
  plan.threads = context.settings.threads;
  return plan;
}

// [{"scenario", "spheres", "max_prims", "inner", "leaves", "tests"}], or null if cancelled.
Json count_rays(const StepContext& context, const FrameRatePlan& plan, int stride, int quick_stride) {
  const Result<FigureWork> work = counted_figure(plan, context.settings.quick ? quick_stride : stride, &context.cancel);
  if (context.cancel.cancelled()) return {};
  Json rows = Json::array();
  for (const auto& [configuration, trees] : cli::value_or_fail(work))
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
    work[{row["scenario"].get<std::int64_t>(), row["spheres"].get<std::int64_t>()}]
        [row["max_prims"].get<std::int64_t>()] = {row["inner"].get<double>(), row["leaves"].get<double>(),
                                                  row["tests"].get<double>()};
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  cli::value_or_fail(FrameRatePlan::from_values(values.stated()));  // every number is in range
  const std::vector<std::int64_t> scenarios = values.integers("scenarios"), counts = values.integers("spheres_list");
  const std::vector<std::int64_t> max_prims = values.integers("max_prims_list");
  std::vector<Step> steps;
  steps.reserve(2 * scenarios.size());
  for (const std::int64_t scenario : scenarios)
    steps.push_back({counts_step(scenario), settings.quick ? 0.5 : 8, [scenario](StepContext& context) {
                       FrameRatePlan plan = plan_of(context, scenario);
                       for (const std::int64_t beyond : context.values.integers("max_prims_beyond"))
                         plan.max_prims.push_back(beyond);
                       plan.max_prims.push_back(kUnlimited);
                       return count_rays(context, plan, 1, kQuickStride);
                     }});
  for (const std::int64_t scenario : scenarios)
    steps.push_back({seeds_step(scenario), settings.quick ? 0.3 : 20, [scenario](StepContext& context) {
                       Json seeds = Json::array();
                       FrameRatePlan plan = plan_of(context, scenario);
                       for (plan.seed = 1; plan.seed <= (context.settings.quick ? kQuickSeeds : kSeeds); ++plan.seed)
                         seeds.push_back(count_rays(context, plan, kOtherStride, kQuickOtherStride));
                       return seeds;
                     }});
  for (const Variation& variation : variations())
    steps.push_back({variation.key, settings.quick ? 0.2 : 2, [variation](StepContext& context) {
                       FrameRatePlan plan = plan_of(context, std::nullopt);
                       variation.change(plan);
                       return count_rays(context, plan, kOtherStride, kQuickOtherStride);
                     }});
  steps.push_back({kBalanceStep, 0.3, [](StepContext& context) {
                     const Values& of = context.values;
                     return measure_reasons(context, {of.integers("scenarios"),
                                                      of.integers("spheres_list"),
                                                      {of.integer("winner.max_prims")},
                                                      context.settings.quick ? 10 : 100});
                   }});
  double all = 0;
  for (const std::int64_t spheres : counts) all += static_cast<double>(spheres) + 100;
  for (const TimedProgram& program : timed_programs())
    for (const std::int64_t scenario : scenarios)
      for (const std::int64_t spheres : counts)
        steps.push_back({times_step(program, scenario, spheres),
                         program.weight / (settings.quick ? 20.0 : 1.0) * (static_cast<double>(spheres) + 100) / all /
                             static_cast<double>(scenarios.size()),
                         [=](StepContext& context) { return program.measure(context, scenario, spheres); }});
  steps.push_back({kBruteForceStep, 1, measure_brute_force});
  return steps;
}

std::string ranges_text(const std::vector<CostRange>& ranges) {
  std::string text;
  for (const CostRange& range : ranges)
    text += (text.empty() ? "" : " or ") + (std::isinf(range.high)
                                                ? fmt::format("{:.2f} or more", range.low)
                                                : fmt::format("{:.2f} to {:.2f}", range.low, range.high));
  return text.empty() ? "nowhere" : text;
}

class FigureData {
 public:
  explicit FigureData(const DataContext& context)
      : context_(context),
        values_(context.values),
        scenarios_(values_.integers("scenarios")),
        counts_(values_.integers("spheres_list")),
        max_prims_(values_.integers("max_prims_list")),
        pattern_(cli::value_or_fail(stated_pattern(values_.stated()))) {
    for (const std::int64_t scenario : scenarios_)
      if (const Json* const rows = context.result(counts_step(scenario))) {
        add_work(*rows, work_);
        for (const Json& row : *rows) data_["counts"].push_back(row);
      }
    complete_ = work_.size() == scenarios_.size() * counts_.size();
  }

  Json all() {
    if (complete_) {
      collect_seeds();
      fit_programs();
      add_diagram();
      add_leaf_costs();
      add_variations();
      add_claims();
    }
    add_rates();
    add_brute_force();
    add_balance();
    add_lost_bars();
    return std::move(data_);
  }

 private:
  // One figure for each seed that was counted. A scenario without random numbers is the same with every seed.
  void collect_seeds() {
    for (const std::int64_t scenario : scenarios_) {
      const Json* const result = context_.result(seeds_step(scenario));
      if (result == nullptr) return seeds_.clear();
      seeds_.resize(result->size());
      for (std::size_t seed = 0; seed < seeds_.size(); ++seed) add_work((*result)[seed], seeds_[seed]);
    }
    data_["seeds"] = seeds_.size();
  }

  // Costs from each program's own times.
  void fit_programs() {
    for (const TimedProgram& program : timed_programs()) {
      EngineTimes times;
      double pixels = 0, fixed_ms = 0;
      std::string gpu;
      for (const std::int64_t scenario : scenarios_)
        for (const std::int64_t spheres : counts_) {
          const Json* const result = context_.result(times_step(program, scenario, spheres));
          if (result == nullptr) continue;
          if (result->contains("missing")) {
            data_["missing_shader"] = (*result)["missing"];
            continue;
          }
          times[{scenario, spheres}] = times_of(*result);
          pixels = result->at("width_px").get<double>() * result->at("height_px").get<double>();
          data_["pixels_that_differ"] = std::max<std::int64_t>(data_.value("pixels_that_differ", std::int64_t{0}),
                                                               result->value("pixels_that_differ", std::int64_t{0}));
          gpu = result->value("gpu", "");
          if (!gpu.empty()) fixed_ms = median(result->at("one_sphere_ms").get<std::vector<double>>());
        }
      if (times.size() != work_.size()) continue;
      const bool on_all_threads = std::string(program.key) == "reference";
      const int threads = context_.settings.threads > 0 ? context_.settings.threads : hardware_threads();
      const double ns_per_ms = 1e6 / pixels * (on_all_threads ? threads : 1);
      const FittedCosts fitted = fit_costs(work_, times, max_prims_, ns_per_ms);
      times_[program.key] = std::move(times);
      if (fitted.frames == 0) continue;
      // Software that takes the place of a graphics processor is none.
      const bool software = is_software(gpu);
      const StepCosts costs = fitted.costs();
      Json row{{"key", program.key},
               {"name", program.name + std::string(software ? " in software, no graphics processor" : "")},
               {"gpu", gpu},
               {"software", software},
               {"fixed_ns", fitted.fixed_ns},
               {"inner_ns", fitted.inner_ns},
               {"leaf_ns", fitted.leaf_ns},
               {"test_ns", fitted.test_ns},
               {"inner_per_test", costs.inner},
               {"inner_per_test_error", fitted.inner_error},
               {"leaf_per_inner", costs.leaf},
               {"leaf_per_inner_error", fitted.leaf_error},
               {"rms_percent", 100 * fitted.rms},
               {"frames", fitted.frames},
               {"wins", wins_of(work_, pattern_.max_prims, max_prims_, costs.inner, costs.leaf)}};
      if (fixed_ms > 0) row["one_sphere_ms"] = fixed_ms;
      data_["fits"].push_back(std::move(row));
      fits_.push_back({program.key, data_["fits"].back()["name"].get<std::string>(), fitted});
    }
  }

  void add_diagram() {
    CostDiagram diagram = cost_diagram(work_, pattern_, max_prims_, seeds_);
    for (const auto& [key, name, fitted] : fits_)
      diagram.points.push_back({name.substr(0, name.find(',')), fitted.costs().inner, fitted.costs().leaf,
                                fitted.inner_error, fitted.leaf_error});
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
    if (const Status status = write_file(context_.folder + "/" + file, text); !status) cli::fail(status.error());
  }

  void add_leaf_costs() {
    for (const double leaf : kLeafCosts) {
      const WinsByCost found = wins_by_cost(work_, pattern_, max_prims_, leaf);
      const auto with = std::count_if(seeds_.begin(), seeds_.end(), [&](const FigureWork& seed) {
        return !wins_by_cost(seed, pattern_, max_prims_, leaf).pattern.empty();
      });
      Json ranges = Json::array();
      for (const CostRange& range : found.pattern)
        ranges.push_back({range.low, std::isinf(range.high) ? Json() : Json(range.high)});
      data_["leaf_costs"].push_back({{"leaf", leaf},
                                     {"most_wins", found.most},
                                     {"stated_text", ranges_text(found.stated)},
                                     {"pattern_text", ranges_text(found.pattern)},
                                     {"pattern", std::move(ranges)},
                                     {"seeds_with", with}});
    }
    const WinsByCost free = wins_by_cost(work_, pattern_, max_prims_, 0);
    const bool same_number = static_cast<std::int64_t>(work_.size()) == values_.integer("winner.configurations");
    data_["possible"] = {{"wins", same_number && !free.stated.empty() ? pattern_.wins : free.most},
                         {"where", ranges_text(free.stated)},
                         {"pattern", ranges_text(free.pattern)},
                         {"most", free.most}};
  }

  void add_variations() {
    for (const Variation& variation : variations()) {
      const Json* const rows = context_.result(variation.key);
      if (rows == nullptr) continue;
      FigureWork work;
      add_work(*rows, work);
      const WinsByCost found = wins_by_cost(work, pattern_, max_prims_, 0);
      data_["variations"].push_back({{"what", variation.what},
                                     {"usual", variation.usual},
                                     {"other", variation.other},
                                     {"most_wins", found.most},
                                     {"pattern_text", ranges_text(found.pattern)}});
    }
  }

  // The asked costs; else the costs within the pattern that suit most of the text's claims, the lowest of equal ones.
  std::optional<StepCosts> chosen_costs() const {
    const std::vector<double>& asked = context_.settings.costs;
    if (asked.size() == 3) return StepCosts{asked[0], asked[1], asked[2]};
    std::optional<StepCosts> best;
    std::int64_t most = -1;
    for (const CostRange& range : wins_by_cost(work_, pattern_, max_prims_, 0).pattern)
      for (int i = 0; i < kTries && std::isfinite(range.high); ++i) {
        const StepCosts costs{range.low + (range.high - range.low) * (i + 0.5) / kTries, 0, 1};
        const std::vector<Finding> findings =
            judge(values_, {{"at", {{"text", quantities_at(work_, costs, values_)}}}});
        const auto agree = std::count_if(findings.begin(), findings.end(),
                                         [](const Finding& each) { return each.verdict == Verdict::agrees; });
        if (agree <= most) continue;
        best = costs;
        most = agree;
      }
    return best;
  }

  // All claims about frame rates at the chosen costs, and beside them at those of each program.
  void add_claims() {
    const std::optional<StepCosts> costs = chosen_costs();
    if (!costs) return;
    data_["at"]["text"] = quantities_at(work_, *costs, values_);
    Json head = Json::array();
    for (const auto& [key, name, fitted] : fits_) {
      data_["at"][key] = quantities_at(work_, fitted.costs(), values_);
      head.push_back(name);
    }
    Json rows = Json::array();
    std::int64_t agree = 0;
    for (const Finding& finding : judge(values_, {{"at", {{"text", data_["at"]["text"]}}}})) {
      agree += finding.verdict == Verdict::agrees ? 1 : 0;
      const std::string of = values_.document()["values"][finding.name]["of"].get<std::string>();
      Json row{{"claim", finding.claim},
               {"row", finding.row},
               {"expected", finding.expected},
               {"ours", finding.ours},
               {"css_class", words_of(finding.verdict, finding.kind).css_class},
               {"sign", words_of(finding.verdict, finding.kind).sign},
               {"elsewhere", Json::array()}};
      for (const auto& [key, name, fitted] : fits_)
        for (const Finding& there : judge_on(values_, finding.name, data_, "at." + key + of.substr(of.find('.', 3))))
          row["elsewhere"].push_back({{"program", name}, {"ours", there.ours}});
      rows.push_back(std::move(row));
    }
    data_["claims_at_costs"] = {{"inner", costs->inner},
                                {"leaf", costs->leaf},
                                {"fixed", costs->fixed},
                                {"asked", !context_.settings.costs.empty()},
                                {"agree", agree},
                                {"all", rows.size()},
                                {"programs", std::move(head)},
                                {"rows", std::move(rows)}};
  }

  // Frames per second, without verdicts, and the thesis program's as charts like the text's.
  void add_rates() {
    for (const auto& [key, times] : times_) {
      Json table{{"key", key}, {"trees", max_prims_}, {"rows", Json::array()}};
      for (const TimedProgram& program : timed_programs())
        if (key == program.key) table["name"] = program.name;
      for (const auto& [configuration, one] : times) {
        Json trees = Json::array();
        for (const auto& [prims, ms] : one.trees)
          trees.push_back({{"tree", tree_name(prims)}, {"fps", frames_per_second(ms)}});
        table["rows"].push_back({{"scenario", configuration.first},
                                 {"spheres", configuration.second},
                                 {"brute_fps", frames_per_second(one.brute)},
                                 {"trees", std::move(trees)},
                                 {"gain_percent", one.gain_percent()}});
      }
      data_["rates"].push_back(std::move(table));
      if (key != timed_programs().front().key) continue;
      for (const std::int64_t scenario : scenarios_)
        write(fmt::format("scenario{}.svg", scenario),
              bar_chart(frame_rate_bars(scenario, counts_, max_prims_, times)));
    }
  }

  // Brute force in the scenarios and with all spheres at one place: the slowest over the fastest.
  void add_brute_force() {
    const Json* const result = context_.result(kBruteForceStep);
    if (result == nullptr) return;
    double most = 0, most_with_one_place = 0;
    for (const auto& [name, times] : result->items()) {
      std::vector<double> ms;
      const auto ratio = [&] {
        return *std::max_element(ms.begin(), ms.end()) / *std::min_element(ms.begin(), ms.end());
      };
      for (const std::int64_t scenario : scenarios_)
        ms.push_back(times.at(fmt::format("scenario{}", scenario)).get<double>());
      most = std::max(most, ratio());
      ms.push_back(times.at("one_place").get<double>());
      most_with_one_place = std::max(most_with_one_place, ratio());
    }
    data_["brute_force"] = {{"scenarios_ratio", most}, {"one_place_ratio", most_with_one_place}, {"ms", *result}};
  }

  // The text's reasons for Scenario 3: how much the leaves of the scenarios deviate.
  void add_balance() {
    const Json* const balance = context_.result(kBalanceStep);
    if (balance == nullptr) return;
    data_["balance"] = *balance;
    for (const Json& row : *balance)
      for (const auto& [name, of] : {std::pair{"deviation", "spheres_per_leaf_sd"}, {"imbalance", "depth_sd"}})
        data_[name][fmt::format("spheres{}", row["spheres"].get<std::int64_t>())][row["scenario"].dump()] = row[of];
  }

  // What the lost bars must have been, by arithmetic on the text's own numbers.
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
  };

  const DataContext& context_;
  const Values& values_;
  const std::vector<std::int64_t> scenarios_, counts_, max_prims_;
  const WinPattern pattern_;
  FigureWork work_;
  bool complete_ = false;
  std::vector<FigureWork> seeds_;
  std::map<std::string, EngineTimes> times_;
  std::vector<Fit> fits_;
  Json data_ = Json::object();
};

}  // namespace

ExperimentCode figure_4_4() {
  return {steps_of, [](const DataContext& context) { return FigureData(context).all(); }};
}

}  // namespace bihive::thesis
