// A run beside an older one: which findings have another verdict?
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "report.h"

namespace bihive::thesis {

/// An older run, read from its results.json.
struct OlderRun {
  struct Words {
    std::string ours, verdict;
  };
  std::string file, version, commit, machine, date;
  std::map<std::pair<std::string, std::string>, Words> findings;  ///< by the experiment's id and the finding's name
};
/// Fails if the file is none.
OlderRun read_older_run(const std::string& file);

/// {"file", "version", "commit", "machine", "date", "same", "changed", "moved", "fresh", "gone", "rows":
/// [{"experiment", "name", "claim", "changed": "verdict" or "value", "then", "now", "then_ours", "now_ours"}]}
Json compared_with(const OlderRun& older, const std::vector<ReportPart>& parts);

}  // namespace bihive::thesis
