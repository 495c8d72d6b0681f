// report.html: one file with everything, without network and server. And results.json for machines.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "thesis/experiment.h"
#include "thesis/machine_load.h"

namespace bihive::cli::thesis {

/// An experiment in the report.
struct ReportSection {
  std::string id, title;
  Section section;
  std::vector<std::string> missing_steps;  ///< empty: complete
  const Values* values;                    ///< for the sentences of the stated values
  MachineLoad load;                        ///< of its steps
};

/// How many of its findings have each verdict, by the kind of the expected value.
struct VerdictCounts {
  struct OfKind {
    int agrees = 0, differs = 0, undecided = 0;
    int all() const { return agrees + differs + undecided; }
  };
  OfKind stated, inferred, own_check;
  int text_inconsistent = 0;
};
VerdictCounts count_verdicts(const Section& section);

struct ReportHeader {
  Settings settings;
  std::string version, commit;
  std::string machine;   ///< processor and threads
  std::string compiler;  ///< and the instruction set that vectors use
  std::string command;   ///< that makes this report
  std::string date;      ///< ISO 8601
  MachineLoad load;      ///< of all steps
};

/// A part of the report that stands before the experiments: the page of verdicts, the runs of other devices, or the
/// comparison with an older run.
struct ReportFront {
  std::string id, title;
  std::vector<std::string> paragraphs;
  Table table;                           ///< left out where it has no rows
  std::vector<std::string> links;        ///< ids of the experiments, one a row, shown as a last column; or none
  std::vector<std::string> row_classes;  ///< of CSS, one a row; or none
  Json data = Json::array();             ///< for results.json
};

/// Pictures are read from `folder` and embedded as data, charts inline. The section and the top of the report name
/// missing parts.
std::string report_html(const ReportHeader& header, const std::vector<ReportFront>& fronts,
                        const std::vector<ReportSection>& sections, const std::string& folder);

/// docs/results.schema.json describes it.
Json results_json(const ReportHeader& header, const std::vector<ReportFront>& fronts,
                  const std::vector<ReportSection>& sections);

}  // namespace bihive::cli::thesis
