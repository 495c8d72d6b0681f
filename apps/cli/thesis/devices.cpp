#include "thesis/devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "support/failure.h"
#include "thesis/compare.h"
#include "thesis/frame_verdicts.h"

namespace bihive::cli::thesis {
namespace {

// A file's run: its words, and the frames of each configuration.
struct DeviceRun {
  std::string device, engine, picture;
  bool quick = false, complete = false;
  EngineTimes times;
  std::vector<double> drifts;  // of each contestant: the last round's time over the first's
};

constexpr const char* kRun = "figure-4.4";
constexpr const char* kShown = "shown-frames";

[[noreturn]] void fail_device(const std::string& file, const std::string& what) {
  fail({"expected a run of the thesis as the page saves it: " + what, file, 0, 0,
        "open the page on the device, choose \"Run the thesis on this device\", then \"Save JSON\""});
}

Json::other_error wrong(const char* what) {
  return Json::other_error::create(501, what, static_cast<const Json*>(nullptr));
}

DeviceRun run_from(const Json& document) {
  DeviceRun run;
  run.device = document.at("device").get<std::string>();
  run.engine = document.at("engine").get<std::string>();
  run.quick = document.at("quick").get<bool>();
  run.complete = document.at("complete").get<bool>();
  run.picture = fmt::format("{} x {}", document.at("width_px").get<int>(), document.at("height_px").get<int>());
  for (const Json& one : document.at("configurations")) {
    const auto ms = one.at("frame_ms").get<std::vector<double>>();
    if (ms.empty() || std::any_of(ms.begin(), ms.end(), [](double each) { return !(each > 0); }))
      throw wrong("a frame without a time");
    ConfigurationTimes& times =
        run.times[{one.at("scenario").get<std::int64_t>(), one.at("spheres").get<std::int64_t>()}];
    const Json& max_prims = one.at("max_prims");
    if (!max_prims.is_null() && max_prims.get<std::int64_t>() < 1) throw wrong("max_prims below 1");
    (max_prims.is_null() ? times.brute : times.trees[max_prims.get<std::int64_t>()]) = ms;
    run.drifts.push_back(ms.back() / ms.front());
  }
  return run;
}

// Frames that a window or a page showed: frames a second by engine (0: wide, else the MAX_PRIMS of the text's tree) and
// motion, then by configuration.
struct ShownFile {
  std::string by, device, picture;
  bool complete = false;
  std::int64_t threads = 0;
  std::map<std::pair<std::int64_t, bool>, std::map<std::pair<std::int64_t, std::int64_t>, double>> fps;
};

ShownFile shown_from(const Json& document) {
  ShownFile shown;
  shown.by = document.at("by").get<std::string>();
  shown.device = document.at("device").get<std::string>();
  shown.picture = fmt::format("{} x {}", document.at("width_px").get<int>(), document.at("height_px").get<int>());
  shown.complete = document.at("complete").get<bool>();
  shown.threads = document.at("threads").get<std::int64_t>();
  for (const Json& one : document.at("configurations")) {
    const Json& max_prims = one.at("max_prims");
    const std::int64_t tree = max_prims.is_null() ? 0 : max_prims.get<std::int64_t>();
    const auto frames = one.at("frames").get<std::int64_t>();
    const auto seconds = one.at("seconds").get<double>();
    if (frames < 1 || !(seconds > 0)) throw wrong("frames without a time");
    shown.fps[{tree, one.at("turning").get<bool>()}]
             [{one.at("scenario").get<std::int64_t>(), one.at("spheres").get<std::int64_t>()}] =
        static_cast<double>(frames) / seconds;
  }
  return shown;
}

// Each file is read once: it may be a pipe.
void read_device(const std::string& file, std::vector<DeviceRun>& runs, std::vector<ShownFile>& shown) {
  const Result<Json> document = json_from_text<Json>(value_or_fail(read_file(file)));
  if (!document) fail_device(file, document.error().message);
  try {
    const Json& experiment = document->at("experiment");
    if (experiment == kRun)
      runs.push_back(run_from(*document));
    else if (experiment == kShown)
      shown.push_back(shown_from(*document));
    else
      throw wrong("another experiment");
  } catch (const Json::exception& error) {
    fail_device(file, error.what());
  }
}

// The best tree's frames of a configuration; null if it has no tree or no brute force.
const std::vector<double>* best_tree(const ConfigurationTimes& times) {
  const std::int64_t fastest = fastest_tree(times);
  return times.brute.empty() || fastest == 0 ? nullptr : &times.trees.at(fastest);
}

// Least, most and mean gain in percent of a scenario; nothing unless all its numbers of spheres are there.
struct Gains {
  double least, most, mean;
};
std::optional<Gains> gains_of(const DeviceRun& run, std::int64_t scenario, std::size_t counts) {
  std::vector<double> gains;
  for (const auto& [key, times] : run.times)
    if (const std::vector<double>* const best = best_tree(times); key.first == scenario && best != nullptr)
      gains.push_back(100 * (median(times.brute) / median(*best) - 1));
  if (gains.size() != counts) return std::nullopt;
  const auto [least, most] = std::minmax_element(gains.begin(), gains.end());
  return Gains{*least, *most, spread_of(gains).mean};
}

std::string gains_text(const std::optional<Gains>& gains) {
  return gains ? fmt::format("{:.0f} to {:.0f} %, mean {:.0f}", gains->least, gains->most, gains->mean) : "";
}

std::vector<Cell> row_of(const DeviceRun& run, const Values& values, Json& data) {
  const std::vector<std::int64_t> counts = values.integers("spheres_list");
  std::vector<Cell> row{
      {run.device}, {run.engine}, {run.picture + (run.quick ? ", quick" : "") + (run.complete ? "" : ", incomplete")}};
  for (const std::int64_t count : counts) {
    const auto found = run.times.find({values.integers("scenarios").front(), count});
    const bool has = found != run.times.end() && !found->second.brute.empty();
    row.push_back({has ? fmt::format("{:.2f}", fps_quartiles(found->second.brute).median) : ""});
  }
  double best_fps = 0;
  std::int64_t wins = 0, complete = 0;
  const std::int64_t winner = values.integer("winner.max_prims");
  for (const auto& [key, times] : run.times) {
    const std::vector<double>* const best = best_tree(times);
    if (best == nullptr) continue;
    ++complete;
    best_fps = std::max(best_fps, 1000 / median(*best));
    if (const auto found = times.trees.find(winner); found != times.trees.end() && &found->second == best) ++wins;
  }
  row.push_back({fmt::format("{:.1f}", best_fps)});
  for (const std::int64_t scenario : values.integers("scenarios"))
    row.push_back({gains_text(gains_of(run, scenario, counts.size()))});
  row.push_back({fmt::format("{} of {}", wins, complete)});
  const double drift = run.drifts.empty() ? 1 : median(run.drifts);
  row.push_back({fmt::format("{:+.1f} %", 100 * (drift - 1))});
  data.push_back({{"device", run.device},
                  {"engine", run.engine},
                  {"quick", run.quick},
                  {"complete", run.complete},
                  {"configurations", complete},
                  {"best_fps", best_fps},
                  {"drift", drift}});
  return row;
}

// What the text says of its phone, in the same columns.
std::vector<Cell> stated_row(const Values& values) {
  std::vector<Cell> row{{"iPhone 5s, stated by the text"}, {""}, {""}};
  for (const std::int64_t count : values.integers("spheres_list")) {
    const std::string name = fmt::format("brute.fps.spheres{}", count);
    row.push_back({values.has(name) ? values.printed(name) : "not stated"});
  }
  row.push_back({values.printed("best.fps") + ", the display's limit"});
  for (const std::int64_t scenario : values.integers("scenarios")) {
    const std::string name = fmt::format("scenario{}.gain_percent.", scenario);
    if (!values.has(name + "least")) {
      row.push_back({"not stated"});
      continue;
    }
    row.push_back({fmt::format("{} to {}{}", values.printed(name + "least"), values.printed(name + "best"),
                               values.has(name + "mean") ? ", mean " + values.printed(name + "mean") : "")});
  }
  row.push_back({fmt::format("{} of {}", values.integer("winner.wins"), values.integer("winner.configurations"))});
  row.push_back({""});
  return row;
}

ReportFront runs_page(const std::vector<DeviceRun>& runs, const Values& values) {
  ReportFront page{"devices", "On other devices", {}, {}, {}, {}, Json::array()};
  page.paragraphs.push_back(
      "Runs of Figure 4.4 that the page made on other devices (\"Run the thesis on this device\", \"Save JSON\"), "
      "beside what the text states of its phone. Engine cpu: the reference tree in WebAssembly; gpu: the same by a "
      "shader. Slow devices draw smaller pictures, with other rates. Medians over the rounds; no verdicts.");
  page.table.title = "Frames a second, gains over brute force, drift";
  page.table.columns = {"Device", "Engine", "Picture"};
  for (const std::int64_t count : values.integers("spheres_list"))
    page.table.columns.push_back(fmt::format("BF {}, fps", count));
  page.table.columns.emplace_back("Best, fps");
  for (const std::int64_t scenario : values.integers("scenarios"))
    page.table.columns.push_back(fmt::format("Gains, Scenario {}", scenario));
  page.table.columns.push_back(fmt::format("BIH {} wins", values.integer("winner.max_prims")));
  page.table.columns.emplace_back("Drift");
  page.table.rows.push_back(stated_row(values));
  for (const DeviceRun& run : runs) page.table.rows.push_back(row_of(run, values, page.data));
  page.table.note =
      "BF: in the first scenario. Drift: the time of the last round over that of the first, the median of all "
      "contestants; a device that grows hot and slow has a positive one.";
  return page;
}

ReportFront shown_page(const std::vector<ShownFile>& files, const Values& values) {
  ReportFront page{"shown_frames", "Frames on a screen", {}, {}, {}, {}, Json::array()};
  page.paragraphs.push_back(
      "How many frames a second a window or a page showed: the scenes of Figure 4.4, drawn by the CPU, turned into "
      "bytes, and brought to the screen. At rest the same picture is drawn anew for each frame; turning, the camera "
      "goes once around. \"BIH n\" is the tree reconstructed from Table 4.2 in scalar code, \"wide\" this program's "
      "tree on vectors. The "
      "text states that its phone shows 60 at most; a browser too stops at its screen's rate, and a window does where "
      "its driver waits for the screen. The rates are reported as they are; no verdicts.");
  page.table.title = "Frames shown a second";
  page.table.columns = {"By", "Engine", "Motion"};
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const std::int64_t count : values.integers("spheres_list")) {
      keys.emplace_back(scenario, count);
      page.table.columns.push_back(fmt::format("{}: {}", scenario, count));
    }
  for (const ShownFile& file : files)
    for (const auto& [engine, by_configuration] : file.fps) {
      const auto& [tree, turning] = engine;
      const std::string name = tree == 0 ? "wide" : fmt::format("BIH {}", tree);
      std::vector<Cell> row{{fmt::format("{}, {}, {} threads{}: {}", file.by, file.picture, file.threads,
                                         file.complete ? "" : ", incomplete", file.device)},
                            {name},
                            {turning ? "turning" : "at rest"}};
      for (const auto& key : keys) {
        const auto found = by_configuration.find(key);
        row.push_back({found == by_configuration.end() ? "" : fmt::format("{:.1f}", found->second)});
      }
      page.table.rows.push_back(std::move(row));
      Json rates = Json::array();
      for (const auto& [key, fps] : by_configuration)
        rates.push_back({{"scenario", key.first}, {"spheres", key.second}, {"fps", fps}});
      page.data.push_back({{"by", file.by},
                           {"device", file.device},
                           {"engine", name},
                           {"turning", turning},
                           {"complete", file.complete},
                           {"rates", std::move(rates)}});
    }
  page.table.note = "Columns: scenario and number of spheres.";
  return page;
}

}  // namespace

std::vector<ReportFront> devices_pages(const std::vector<std::string>& files, const Values& values) {
  std::vector<DeviceRun> runs;
  std::vector<ShownFile> shown;
  for (const std::string& file : files) read_device(file, runs, shown);
  std::vector<ReportFront> pages;
  if (!runs.empty()) pages.push_back(runs_page(runs, values));
  if (!shown.empty()) pages.push_back(shown_page(shown, values));
  return pages;
}

}  // namespace bihive::cli::thesis
