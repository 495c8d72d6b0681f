// The result of a run of Figure 4.4: as JSON, and as charts beside the thesis's values for the iPhone 5s.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/viewer/frame_rates.h"

namespace bihive {

/// {"experiment", "engine", "device", "width_px", "height_px", "quick", "rounds", "configurations": [{"scenario",
/// "spheres", "max_prims" (null: brute force), "fps", "frame_ms": [...]}], "gains": [{"scenario", "spheres",
/// "max_prims" (of the best tree), "percent"}], "stated": {name: {"value", "sentence"}}}. `device`: a description of
/// the device by the caller. `values_json`: thesis/figure-4.4/values.json.
std::string frame_rates_json(const FrameRateRun& run, std::string_view values_json, const std::string& engine,
                             const std::string& device);

/// SVG texts (image/svg_chart.h): the gains over brute force beside the stated ones, then the frame rates of each
/// scenario beside the few that the thesis states. `here` names this device in the legend.
std::vector<std::string> frame_rates_charts(const FrameRateRun& run, std::string_view values_json,
                                            const std::string& here);

}  // namespace bihive
