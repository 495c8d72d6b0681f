// Runs of Figure 4.4 and frames shown per second that were measured on other devices.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "bihive/math/quartiles.h"
#include "bihive/thesis/frame_rates_report.h"
#include "report.h"

namespace bihive::thesis {
namespace {

Json::other_error wrong(const char* what) {
  return Json::other_error::create(501, what, static_cast<const Json*>(nullptr));
}

std::string picture_of(const Json& document) {
  return fmt::format("{} x {}", document.at("width_px").get<int>(), document.at("height_px").get<int>());
}

Json run_from(const Json& document, const Values& values) {
  const std::optional<SavedFrameRates> saved = saved_frame_rates(document.dump());
  if (!saved) throw wrong("a size, a round or the time of a frame is not there");
  std::int64_t wins = 0, configurations = 0;
  double best_fps = 0;
  std::map<std::int64_t, std::vector<double>> gains;
  for (const auto& [key, times] : times_of(saved->rates)) {
    const std::int64_t fastest = times.fastest();
    if (times.brute.empty() || fastest == 0) continue;
    ++configurations;
    wins += fastest == values.integer("winner.max_prims") ? 1 : 0;
    best_fps = std::max(best_fps, frames_per_second(times.trees.at(fastest)));
    gains[key.first].push_back(times.gain_percent());
  }
  Json by_scenario = Json::array();
  for (const auto& [scenario, percents] : gains) {
    const auto [least, most] = std::minmax_element(percents.begin(), percents.end());
    by_scenario.push_back(
        {{"scenario", scenario}, {"least", *least}, {"most", *most}, {"mean", mean_and_sd(percents).mean}});
  }
  // The size of the picture relative to the text's.
  const double scale = static_cast<double>(saved->width_px) * saved->height_px /
                       (values.number("width_px") * values.number("height_px"));
  Json run = {{"device", document.at("device").get<std::string>()},
              {"engine", saved->engine},
              {"picture", picture_of(document)},
              {"quick", saved->quick},
              {"complete", document.at("complete").get<bool>()},
              {"configurations", configurations},
              {"wins", wins},
              {"best_fps", best_fps},
              {"best_fps_scaled", best_fps * scale},
              {"gains", std::move(by_scenario)},
              {"drift", drift_of(saved->rates)}};
  // Costs of the page's steps; runs of earlier versions lack them.
  if (document.contains("costs")) {
    Json& costs = run["costs"];
    for (const char* const name : {"inner_per_test", "inner_per_test_error", "leaf_per_inner", "leaf_per_inner_error"})
      costs[name] = document["costs"].at(name).get<double>();
    const CostWords words = cost_words(costs["inner_per_test"], costs["inner_per_test_error"], costs["leaf_per_inner"],
                                       costs["leaf_per_inner_error"]);
    costs.update({{"inner_words", words.inner}, {"leaf_words", words.leaf}});
  }
  return run;
}

// Frames that a window or a page showed: a row for each engine, at rest and turning.
void add_shown(const Json& document, Json& data) {
  std::map<std::pair<std::int64_t, bool>, Json> rates;  // by MAX_PRIMS (0: the wide engine) and motion
  for (const Json& one : document.at("configurations")) {
    const Json& max_prims = one.at("max_prims");
    const auto frames = one.at("frames").get<std::int64_t>();
    const auto seconds = one.at("seconds").get<double>();
    if (frames < 1 || !(seconds > 0)) throw wrong("frames without a time");
    rates[{max_prims.is_null() ? 0 : max_prims.get<std::int64_t>(), one.at("turning").get<bool>()}].push_back(
        {{"scenario", one.at("scenario").get<std::int64_t>()},
         {"spheres", one.at("spheres").get<std::int64_t>()},
         {"fps", static_cast<double>(frames) / seconds}});
  }
  for (auto& [key, list] : rates)
    data["shown"].push_back({{"by", document.at("by").get<std::string>()},
                             {"device", document.at("device").get<std::string>()},
                             {"picture", picture_of(document)},
                             {"threads", document.at("threads").get<std::int64_t>()},
                             {"engine", key.first == 0 ? std::string("wide") : fmt::format("BIH {}", key.first)},
                             {"turning", key.second},
                             {"complete", document.at("complete").get<bool>()},
                             {"rates", std::move(list)}});
}

// All 54 configurations together, one frame of each, in the first minute and in the last one.
Json heat_of(const Json& passes, const Json& engine) {
  std::map<std::int64_t, std::vector<double>> by_minute;
  for (const Json& pass : passes)
    if (pass.at("engine") == engine)
      by_minute[pass.at("minute").get<std::int64_t>()].push_back(pass.at("round_ms").get<double>());
  if (by_minute.size() < 2) return {};
  const auto& [first, first_ms] = *by_minute.begin();
  const auto& [last, last_ms] = *by_minute.rbegin();
  return {{"first_minute", first}, {"first_ms", median(first_ms)}, {"last_minute", last}, {"last_ms", median(last_ms)}};
}

void add_document(const Json& document, const Values& values, Json& data) {
  const Json& experiment = document.at("experiment");
  if (experiment == "figure-4.4") {
    data["runs"].push_back(run_from(document, values));
  } else if (experiment == "shown-frames") {
    add_shown(document, data);
  } else if (experiment == "phone") {
    for (const Json& run : document.at("runs")) {
      add_document(run, values, data);
      if (Json heat = heat_of(document.at("passes"), run.at("engine")); !heat.is_null())
        data["runs"].back()["heat"] = std::move(heat);
    }
    add_document(document.at("shown"), values, data);
  } else {
    throw wrong("another experiment");
  }
}

}  // namespace

Json devices_data(const std::vector<std::string>& files, const Values& figure_4_4) {
  Json data = Json::object();
  for (const std::string& file : files) {
    // Each file is read once: it may be a pipe.
    const Result<Json> document = json_from_text<Json>(value_or_fail(read_file(file)));
    std::string fault = document ? "" : document.error().message;
    try {
      if (document) add_document(*document, figure_4_4, data);
    } catch (const Json::exception& error) {
      fault = error.what();
    }
    if (!fault.empty())
      fail({"expected a run of the thesis as the page saves it: " + fault, file, 0, 0,
            "open the page on the device, choose \"Run the thesis on this device\", then \"Save JSON\""});
  }
  return data;
}

}  // namespace bihive::thesis
