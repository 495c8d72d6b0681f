// report.html: one file with everything, without network and server. And results.json for machines.
#pragma once

#include <string>
#include <vector>

#include "thesis/experiment.h"

namespace bihive::cli::thesis {

/// An experiment in the report.
struct ReportSection {
  std::string id, title;
  Section section;
  std::vector<std::string> missing_steps;  ///< empty: complete
  const Values* values;                    ///< for the sentences of the stated values
};

/// The number of cells that agree with the thesis, and of those that differ.
struct Verdicts {
  int agree = 0, differ = 0;
};
Verdicts count_verdicts(const Section& section);

struct ReportHeader {
  Settings settings;
  std::string version, commit, machine;  ///< machine: processor and threads
  std::string date;                      ///< ISO 8601
};

/// Pictures are read from `folder` and embedded as data, charts inline. The section and the top of the report name
/// missing parts.
std::string report_html(const ReportHeader& header, const std::vector<ReportSection>& sections,
                        const std::string& folder);

/// docs/results.schema.json describes it.
Json results_json(const ReportHeader& header, const std::vector<ReportSection>& sections);

}  // namespace bihive::cli::thesis
