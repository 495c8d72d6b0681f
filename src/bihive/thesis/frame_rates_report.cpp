#include "bihive/thesis/frame_rates_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "bihive/base/json_text.h"
#include "bihive/math/quartiles.h"
#include "bihive/thesis/cost_diagram.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

constexpr const char* kStatedDevice = "iPhone 5s, stated";

std::optional<double> stated_number(const StatedValues& values, const std::string& name) {
  const Result<double> number = values.number(name);
  return number ? std::optional(*number) : std::nullopt;
}

bool has_values(const Series& series) {
  return std::any_of(series.values.begin(), series.values.end(), [](const auto& value) { return value.has_value(); });
}

// Empty if the scenario has no measurement.
std::string scenario_chart(const FrameRateRun& run, const StatedValues& stated, std::int64_t scenario) {
  const FrameRatePlan& plan = run.plan();
  ChartData chart = frame_rate_bars(scenario, plan.spheres, plan.max_prims, times_of(run.rates()));
  if (!has_values(chart.series.front())) return "";
  chart.logarithmic = true;

  // Add the thesis's values, if it states any. It states that brute force does not depend on the scenario. A smaller
  // picture has other rates.
  const auto is = [&](const char* name, std::int64_t wanted) {
    return stated_number(stated, name) == static_cast<double>(wanted);
  };
  if (!is("width_px", plan.width_px) || !is("height_px", plan.height_px)) return bar_chart(chart);
  Series brute{fmt::format("BF, {}", kStatedDevice), {}};
  Series tree{fmt::format("BIH {}, {}", stated_number(stated, "best.max_prims").value_or(0), kStatedDevice), {}};
  for (const std::int64_t spheres : plan.spheres) {
    const bool best = is("best.scenario", scenario) && is("best.spheres", spheres);
    brute.values.push_back(stated_number(stated, fmt::format("brute.fps.spheres{}", spheres)));
    tree.values.push_back(best ? stated_number(stated, "best.fps") : std::nullopt);
  }
  for (const Series* series : {&brute, &tree})
    if (has_values(*series)) chart.series.push_back(*series);
  return bar_chart(chart);
}

}  // namespace

ChartData frame_rate_bars(std::int64_t scenario, const std::vector<std::int64_t>& spheres,
                          const std::vector<std::int64_t>& max_prims, const EngineTimes& times) {
  ChartData bars{
      fmt::format("Scenario {}: frames per second", scenario), "spheres", "frames per second", {}, {}, false};
  bars.series.push_back({"BF", {}});
  for (const std::int64_t each : max_prims) bars.series.push_back({tree_name(each), {}});
  for (const std::int64_t count : spheres) {
    bars.categories.push_back(std::to_string(count));
    const auto found = times.find({scenario, count});
    for (std::size_t i = 0; i < bars.series.size(); ++i)
      bars.series[i].values.push_back(
          found == times.end() ? std::nullopt
                               : std::optional(frames_per_second(i == 0 ? found->second.brute
                                                                        : found->second.trees.at(max_prims[i - 1]))));
  }
  return bars;
}

double drift_of(const std::vector<MeasuredRate>& rates) {
  std::vector<double> drifts;
  for (const MeasuredRate& rate : rates)
    if (rate.frame_ms.size() > 1) drifts.push_back(rate.frame_ms.back() / rate.frame_ms.front());
  return drifts.empty() ? 1 : median(drifts);
}

Result<MeasuredCosts> measured_costs(const FrameRateRun& run, const StatedValues& values, int threads) {
  // Every fourth row and column is enough for means. The picture is the thesis's, whatever the size of the run's.
  constexpr int kStride = 4;
  const Result<FrameRatePlan> whole = FrameRatePlan::from_values(values);
  if (!whole) return whole.error();
  const Result<WinPattern> pattern = stated_pattern(values);
  if (!pattern) return pattern.error();
  FrameRatePlan counted = run.plan();
  const double pixels = static_cast<double>(counted.width_px) * counted.height_px;
  counted.width_px = whole->width_px;
  counted.height_px = whole->height_px;
  Result<FigureWork> work = counted_figure(counted, kStride);
  if (!work) return work.error();
  MeasuredCosts costs{std::move(*work), *pattern, {}, 0};
  costs.fitted = fit_costs(costs.work, times_of(run.rates()), 1e6 / pixels * threads);
  if (costs.fitted.frames > 0) costs.wins = wins_of(costs.work, costs.pattern, costs.fitted.costs());
  return costs;
}

std::string frame_rates_json(const FrameRateRun& run, const StatedValues& values, const std::string& engine,
                             const MeasuringDevice& device, const MeasuredCosts* costs) {
  const FrameRatePlan& plan = run.plan();
  ordered_json json;
  json["experiment"] = "figure-4.4";
  json["engine"] = engine;
  json["device"] = device.words;
  for (const auto& [name, value] : device.facts) json[name] = value;
  json["width_px"] = plan.width_px;
  json["height_px"] = plan.height_px;
  json["quick"] = plan.quick;
  json["rounds"] = plan.rounds;
  json["complete"] = run.finished() && static_cast<int>(run.rates().size()) == plan.configurations();
  json["drift"] = drift_of(run.rates());
  json["configurations"] = ordered_json::array();
  for (const MeasuredRate& rate : run.rates())
    json["configurations"].push_back({{"scenario", rate.scenario},
                                      {"spheres", rate.spheres},
                                      {"max_prims", rate.max_prims ? ordered_json(*rate.max_prims) : ordered_json()},
                                      {"fps", frames_per_second(rate.frame_ms)},
                                      {"frame_ms", rate.frame_ms}});
  if (costs != nullptr && costs->fitted.frames > 0) {
    ordered_json& row = json["costs"];
    for (const auto& [name, value] : costs->fitted.named()) row[name] = value;
    row.update({{"inner_words", costs->fitted.words().inner},
                {"leaf_words", costs->fitted.words().leaf},
                {"determined", costs->fitted.determined()},
                {"rms", costs->fitted.rms},
                {"winner", tree_name(costs->pattern.max_prims)},
                {"wins", costs->wins},
                {"configurations", costs->work.size()}});
  }
  json["stated"] = ordered_json::object();
  const ordered_json stated = *json_from_text<ordered_json>(values.text());
  for (const auto& [name, entry] : stated["values"].items())
    if (entry["kind"] != "inferred" && entry["kind"] != "own_check") json["stated"][name] = entry;
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::optional<SavedFrameRates> saved_frame_rates(const std::string& json) {
  const Result<ordered_json> parsed = json_from_text<ordered_json>(json);
  if (!parsed) return std::nullopt;
  const ordered_json& document = *parsed;
  SavedFrameRates saved;
  try {
    if (document.at("experiment") != "figure-4.4") return std::nullopt;
    saved.engine = document.at("engine").get<std::string>();
    saved.width_px = document.at("width_px").get<int>();
    saved.height_px = document.at("height_px").get<int>();
    saved.rounds = document.at("rounds").get<int>();
    saved.quick = document.at("quick").get<bool>();
    for (const ordered_json& one : document.at("configurations")) {
      MeasuredRate rate{one.at("scenario").get<std::int64_t>(), one.at("spheres").get<std::int64_t>(), std::nullopt,
                        one.at("frame_ms").get<std::vector<double>>()};
      if (!one.at("max_prims").is_null()) rate.max_prims = one.at("max_prims").get<std::int64_t>();
      const bool timed = std::all_of(rate.frame_ms.begin(), rate.frame_ms.end(), [](double ms) { return ms > 0; });
      if (!timed || rate.frame_ms.empty() || rate.max_prims.value_or(1) < 1) return std::nullopt;
      saved.rates.push_back(std::move(rate));
    }
  } catch (const ordered_json::exception&) {
    return std::nullopt;
  }
  if (saved.width_px < 1 || saved.height_px < 1 || saved.rounds < 1) return std::nullopt;
  return saved;
}

std::vector<std::string> frame_rates_charts(const FrameRateRun& run, const StatedValues& values,
                                            const std::string& here, const MeasuredCosts* costs) {
  std::vector<std::string> charts;
  if (costs != nullptr && costs->fitted.frames > 0) {
    CostDiagram diagram = cost_diagram(costs->work, costs->pattern, {});
    if (costs->fitted.determined()) diagram.points = {{here, costs->fitted}};
    charts.push_back(cost_diagram_svg(diagram));
  }
  for (const std::int64_t scenario : run.plan().scenarios)
    if (std::string chart = scenario_chart(run, values, scenario); !chart.empty()) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace bihive
