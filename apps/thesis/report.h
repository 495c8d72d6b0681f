// report.html: one file with everything, without network and server. And results.json for machines.
//
// All words and the layout stand in templates of Mustache: thesis/report/report.html, and thesis/EXPERIMENT/report.html
// for each experiment. A template sees the experiment's data by name. Besides:
//   {{key}}_rows        of an object of objects: the same as a list, each with its "key"
//   {{#f2}}..{{/f2}}    a number with two decimals; f0 to f4; {{#grouped}} with commas between thousands
//   {{#figure}}FILE|CAPTION{{/figure}}     a picture of the output folder, or a chart, as a figure
//   {{> findings}}      the experiment's findings as a table
#pragma once

#include <string>
#include <vector>

#include "claims.h"
#include "machine_load.h"

namespace bihive::thesis {

/// An experiment in the report.
struct ReportPart {
  const Experiment* experiment;
  const Values* values;
  Json data;
  std::vector<Finding> findings;
  std::vector<Claim> claims;
  std::vector<std::string> missing_steps;  ///< empty: complete
  MachineLoad load;                        ///< of its steps
};

struct Report {
  Settings settings;
  /// {"version", "commit", "command" (that makes this report), "compiler" (and the instruction set that vectors use),
  /// "machine" (processor and threads), "date" (ISO 8601)}
  Json about;
  MachineLoad load;  ///< of all steps
  std::vector<ReportPart> parts;
  Json devices = Json::object();  ///< devices_data()
  Json against;                   ///< compared_with(); null: there is no older run
};

/// Pictures are read from `folder` and embedded as data, charts inline.
std::string report_html(const Report& report, const std::string& folder);

/// docs/results.schema.json describes it.
Json results_json(const Report& report);

/// A line for the terminal: "24 reproduced, 12 set as stated, ...".
std::string summary_of(const std::vector<ReportPart>& parts);

}  // namespace bihive::thesis
