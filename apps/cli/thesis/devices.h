// Runs of Figure 4.4 on other devices: files that the page's "Run the thesis on this device" saves.
#pragma once

#include <string>
#include <vector>

#include "thesis/report.h"

namespace bihive::cli::thesis {

/// One row a file, beside what the text states of its iPhone 5s. Fails if a file is no such run.
ReportFront devices_page(const std::vector<std::string>& files, const Values& figure_4_4);

}  // namespace bihive::cli::thesis
