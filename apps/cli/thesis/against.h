// A run beside an older one: which findings have another verdict?
#pragma once

#include <string>
#include <vector>

#include "thesis/report.h"

namespace bihive::cli::thesis {

/// `file` is a results.json of an older run. Fails if it is none.
ReportFront compared_with(const std::string& file, const std::vector<ReportSection>& sections);

}  // namespace bihive::cli::thesis
