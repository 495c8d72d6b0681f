// report.html: everything in one file that needs no network and no server, and results.json for machines.
#pragma once

#include <string>
#include <vector>

#include "thesis/experiment.h"

namespace bihive::cli::thesis {

/// An experiment as the report shows it.
struct ReportSection {
  std::string id, title;
  Section section;
  std::vector<std::string> missing_steps;  ///< empty: complete
  const Values* values;                    ///< for the sentences behind the stated values
};

/// How many cells agree with the thesis, and how many differ.
struct Verdicts {
  int agree = 0, differ = 0;
};
Verdicts count_verdicts(const Section& section);

struct ReportHeader {
  Settings settings;
  std::string version, commit, machine;  ///< machine: processor and threads
  std::string date;                      ///< ISO 8601
};

/// Pictures are read from `folder` and embedded as data, charts inline. What is missing is said in the section and on
/// top.
std::string report_html(const ReportHeader& header, const std::vector<ReportSection>& sections,
                        const std::string& folder);

/// docs/results.schema.json describes it.
Json results_json(const ReportHeader& header, const std::vector<ReportSection>& sections);

}  // namespace bihive::cli::thesis
