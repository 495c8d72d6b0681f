// The result of a run of Figure 4.4: as JSON, and as charts beside the thesis's values for the iPhone 5s.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/image/svg_chart.h"
#include "bihive/thesis/cost_model.h"
#include "bihive/thesis/frame_rates.h"
#include "bihive/thesis/stated_values.h"

namespace bihive {

/// The thesis's chart: a group of bars for each number of spheres, brute force first.
ChartData frame_rate_bars(std::int64_t scenario, const std::vector<std::int64_t>& spheres,
                          const std::vector<std::int64_t>& max_prims, const EngineTimes& times);

/// The measuring machine. `words`: any description. `facts`: names and values for machines ("browser", "gpu").
struct MeasuringDevice {
  std::string words;
  std::vector<std::pair<std::string, std::string>> facts = {};
};

/// The time of the last round over that of the first: the median of all rates with two rounds or more, 1 without any.
/// Above 1 on a device that slows down as it heats up.
double drift_of(const std::vector<MeasuredRate>& rates);

/// The cost of the steps of a ray here, by the frames of a complete run, and what the text states.
struct MeasuredCosts {
  FigureWork work;        ///< of the plan's trees
  WinPattern pattern;     ///< the text's
  FittedCosts fitted;     ///< `frames` is 0 without a fit
  std::int64_t wins = 0;  ///< configurations that the text's winner wins at these costs
};
/// Counts the work of a complete run's trees; takes about a second. `threads`: that draw; the graphics processor
/// counts as one. Error: a value is missing.
Result<MeasuredCosts> measured_costs(const FrameRateRun& run, const StatedValues& values, int threads);

/// {"experiment", "engine", "device", (its facts), "width_px", "height_px", "quick", "rounds", "complete", "drift",
/// "configurations": [{"scenario", "spheres", "max_prims" (null: brute force), "fps", "frame_ms": [...]}], "stated":
/// {name: {"value", "sentence"}}}; with `costs` also "costs": {the members of FittedCosts::named(), "inner_words",
/// "leaf_words", "determined", "rms", "winner", "wins", "configurations"}.
std::string frame_rates_json(const FrameRateRun& run, const StatedValues& values, const std::string& engine,
                             const MeasuringDevice& device, const MeasuredCosts* costs = nullptr);

/// Extracts from such a text what FrameRateRun::resume() needs.
struct SavedFrameRates {
  std::string engine;
  int width_px = 0, height_px = 0, rounds = 0;
  bool quick = false;
  std::vector<MeasuredRate> rates;
};
/// Nothing if the text is not such a result.
std::optional<SavedFrameRates> saved_frame_rates(const std::string& json);

/// SVG texts: the frame rates of each scenario beside the few that the thesis states. With `costs`, the diagram of the
/// winner by cost comes first, with this device as a point of the name `here` if its costs are determined.
std::vector<std::string> frame_rates_charts(const FrameRateRun& run, const StatedValues& values,
                                            const std::string& here, const MeasuredCosts* costs = nullptr);

}  // namespace bihive
