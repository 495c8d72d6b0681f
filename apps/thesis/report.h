// report.html: one file with everything, without network and server. And results.json for machines.
//
// All text and the layout are in Mustache templates: thesis/report/report.html, and thesis/EXPERIMENT/report.html for
// each experiment. A template sees the experiment's data by name. Besides:
//   {{key}}_rows        of an object of objects: the same as a list, each with its "key"
//   {{#f2}}..{{/f2}}    a number with two decimals; f0 to f4; {{#grouped}} with commas between thousands
//   {{#figure}}FILE|CAPTION{{/figure}}     a picture of the output folder, or a chart, as a figure
//   {{> findings}}      the experiment's findings as a table
#pragma once

#include <string>
#include <vector>

#include "experiment.h"

namespace bihive::thesis {

struct Report {
  const Settings& settings;
  std::list<Experiment> parts = {};  ///< those to be shown; their steps refer to them
  /// {"version", "commit", "command" (that makes this report), "compiler" (and the instruction set that vectors use),
  /// "machine" (processor and threads), "date" (ISO 8601)}
  Json about = {};
  Json devices = Json::object();  ///< devices_data()

  /// {"most_others" (the largest share of the processors' time that went to other programs in a step; null: unknown),
  /// "busy" (so large that its times say little)}
  Json load() const;
};

/// Measurements of other devices, in files saved by the page's "Run the thesis on this device" and, for the window, by
/// scripts/shown_frames: {"runs": [...], "shown": [...]}; a list without a file is omitted. The report shows runs
/// beside the text's values for its phone. Fails if a file is neither.
Json devices_data(const std::vector<std::string>& files, const Values& figure_4_4);

/// Pictures are read from `folder` and embedded as data, charts inline.
std::string report_html(const Report& report, const std::string& folder);

/// docs/results.schema.json describes it.
Json results_json(const Report& report);

/// A line for the terminal: "24 reproduced, 12 set as stated, ...".
std::string summary_of(const Report& report);

}  // namespace bihive::thesis
