// The page of verdicts: what the thesis claims, one line a claim, and what became of it in this run.
#pragma once

#include <vector>

#include "thesis/report.h"

namespace bihive::cli::thesis {

/// From thesis/report/claims.json and the findings of the sections. A claim whose experiment was not run is left out.
ReportFront verdict_page(const std::vector<ReportSection>& sections);

}  // namespace bihive::cli::thesis
