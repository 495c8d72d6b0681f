// A run beside an older one: which findings have another verdict?
#pragma once

#include <string>
#include <vector>

#include "report.h"

namespace bihive::thesis {

/// An older run from its results.json: {"file", "version", "commit", "machine", "date", "findings": {"experiment
/// name": {"ours", "verdict"}}}. Fails if the file is none.
Json read_older_run(const std::string& file);

/// {"file", "version", "commit", "machine", "date", "same", "changed", "moved", "fresh", "gone", "rows":
/// [{"experiment", "name", "claim", "changed": "verdict" or "value", "then", "now", "then_ours", "now_ours"}]}
Json compared_with(Json older, const std::vector<ReportPart>& parts);

}  // namespace bihive::thesis
