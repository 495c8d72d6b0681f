#include "bihive/viewer/frame_rates_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "bihive/image/svg_chart.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

constexpr const char* kStatedDevice = "iPhone 5s, stated";

// The numbers that the thesis states.
class Stated {
 public:
  explicit Stated(std::string_view values_json)
      : values_(ordered_json::parse(values_json, nullptr, false).value("values", ordered_json::object())) {}

  std::optional<double> number(const std::string& name) const {
    const auto entry = values_.find(name);
    if (entry == values_.end() || !entry->contains("value") || !(*entry)["value"].is_number()) return std::nullopt;
    return (*entry)["value"].get<double>();
  }

  // The frame rate of brute force (without max_prims) or of a tree. The thesis says that brute force does not depend on
  // the scenario.
  std::optional<double> fps(std::int64_t scenario, std::int64_t spheres, std::optional<std::int64_t> max_prims) const {
    if (!max_prims) return number(fmt::format("brute.fps.spheres{}", spheres));
    const auto is = [&](const char* name, std::int64_t wanted) {
      return number(fmt::format("best.{}", name)) == static_cast<double>(wanted);
    };
    if (is("scenario", scenario) && is("spheres", spheres) && is("max_prims", *max_prims)) return number("best.fps");
    return std::nullopt;
  }

  const ordered_json& all() const { return values_; }

 private:
  ordered_json values_;
};

struct Gain {
  std::int64_t scenario, spheres, max_prims;
  double percent;
};

// The gain of the best tree over brute force, for every complete group.
std::vector<Gain> gains_of(const std::vector<MeasuredRate>& rates) {
  std::vector<Gain> gains;
  double brute = 0;
  for (const MeasuredRate& rate : rates) {
    if (!rate.max_prims) {
      brute = rate.fps();
      continue;
    }
    const double percent = 100 * (rate.fps() / brute - 1);
    if (gains.empty() || gains.back().scenario != rate.scenario || gains.back().spheres != rate.spheres)
      gains.push_back({rate.scenario, rate.spheres, *rate.max_prims, percent});
    else if (percent > gains.back().percent)
      gains.back() = {rate.scenario, rate.spheres, *rate.max_prims, percent};
  }
  return gains;
}

std::string tree_name(std::int64_t max_prims) {
  return fmt::format("BIH {}", max_prims);
}

// Least, greatest and mean gain of each scenario, as the thesis names them; only for scenarios without missing groups.
std::string gains_chart(const FrameRateRun& run, const Stated& stated, const std::string& here) {
  ChartData chart{"Gain of the best tree over brute force", "",   "percent", {},
                  {{here, {}}, {kStatedDevice, {}}},        false};
  const std::vector<Gain> gains = gains_of(run.rates());
  for (const std::int64_t scenario : run.plan().scenarios) {
    std::vector<double> percents;
    for (const Gain& gain : gains)
      if (gain.scenario == scenario) percents.push_back(gain.percent);
    if (percents.size() != run.plan().spheres.size()) continue;
    double sum = 0;
    for (const double percent : percents) sum += percent;
    const auto [least, most] = std::minmax_element(percents.begin(), percents.end());
    const std::pair<const char*, double> rows[] = {
        {"least", *least}, {"best", *most}, {"mean", sum / static_cast<double>(percents.size())}};
    for (const auto& [name, percent] : rows) {
      chart.categories.push_back(fmt::format("{} {}", scenario, std::string(name) == "best" ? "most" : name));
      chart.series[0].values.emplace_back(percent);
      chart.series[1].values.push_back(stated.number(fmt::format("scenario{}.gain_percent.{}", scenario, name)));
    }
  }
  chart.x_label = "scenario: least, most and mean over the numbers of spheres";
  return chart.categories.empty() ? "" : bar_chart(chart);
}

std::string scenario_chart(const FrameRateRun& run, const Stated& stated, std::int64_t scenario) {
  ChartData chart{
      fmt::format("Scenario {}: frames per second", scenario), "spheres", "frames per second", {}, {}, true};
  const std::vector<std::int64_t>& max_prims = run.plan().max_prims;
  chart.series.push_back({"BF", {}});
  for (const std::int64_t each : max_prims) chart.series.push_back({tree_name(each), {}});
  Series stated_brute{fmt::format("BF, {}", kStatedDevice), {}}, stated_tree{fmt::format("BIH, {}", kStatedDevice), {}};
  bool any = false;
  for (const std::int64_t spheres : run.plan().spheres) {
    chart.categories.push_back(std::to_string(spheres));
    for (Series& series : chart.series) series.values.emplace_back();
    stated_brute.values.push_back(stated.fps(scenario, spheres, std::nullopt));
    stated_tree.values.emplace_back();
    for (const std::int64_t each : max_prims)
      if (const auto fps = stated.fps(scenario, spheres, each)) {
        stated_tree.values.back() = fps;
        stated_tree.name = fmt::format("{}, {}", tree_name(each), kStatedDevice);
      }
    for (const MeasuredRate& rate : run.rates()) {
      if (rate.scenario != scenario || rate.spheres != spheres) continue;
      const auto tree =
          rate.max_prims ? std::find(max_prims.begin(), max_prims.end(), *rate.max_prims) - max_prims.begin() + 1 : 0;
      chart.series[static_cast<std::size_t>(tree)].values.back() = rate.fps();
      any = true;
    }
  }
  if (!any) return "";
  for (Series* series : {&stated_brute, &stated_tree})
    if (std::any_of(series->values.begin(), series->values.end(), [](const auto& value) { return value.has_value(); }))
      chart.series.push_back(*series);
  return bar_chart(chart);
}

}  // namespace

std::string frame_rates_json(const FrameRateRun& run, std::string_view values_json, const std::string& engine,
                             const std::string& device) {
  const FrameRatePlan& plan = run.plan();
  ordered_json json;
  json["experiment"] = "figure-4.4";
  json["engine"] = engine;
  json["device"] = device;
  json["width_px"] = plan.width_px;
  json["height_px"] = plan.height_px;
  json["quick"] = plan.quick;
  json["rounds"] = plan.rounds;
  json["complete"] = run.finished() && static_cast<int>(run.rates().size()) == plan.configurations();
  json["configurations"] = ordered_json::array();
  for (const MeasuredRate& rate : run.rates())
    json["configurations"].push_back({{"scenario", rate.scenario},
                                      {"spheres", rate.spheres},
                                      {"max_prims", rate.max_prims ? ordered_json(*rate.max_prims) : ordered_json()},
                                      {"fps", rate.fps()},
                                      {"frame_ms", rate.frame_ms}});
  json["gains"] = ordered_json::array();
  for (const Gain& gain : gains_of(run.rates()))
    json["gains"].push_back({{"scenario", gain.scenario},
                             {"spheres", gain.spheres},
                             {"max_prims", gain.max_prims},
                             {"percent", gain.percent}});
  json["stated"] = ordered_json::object();
  const Stated stated(values_json);
  for (const auto& [name, entry] : stated.all().items())
    if (!entry.contains("chosen")) json["stated"][name] = entry;
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::vector<std::string> frame_rates_charts(const FrameRateRun& run, std::string_view values_json,
                                            const std::string& here) {
  const Stated stated(values_json);
  std::vector<std::string> charts;
  const auto add = [&charts](std::string chart) {
    if (!chart.empty()) charts.push_back(std::move(chart));
  };
  add(gains_chart(run, stated, here));
  for (const std::int64_t scenario : run.plan().scenarios) add(scenario_chart(run, stated, scenario));
  return charts;
}

}  // namespace bihive
