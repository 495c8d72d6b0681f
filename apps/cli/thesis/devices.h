// What other devices measured: runs of Figure 4.4 and frames shown a second, files that the page's "Run the thesis on
// this device" saves, and the window's by scripts/shown_frames.
#pragma once

#include <string>
#include <vector>

#include "thesis/report.h"

namespace bihive::cli::thesis {

/// The runs of Figure 4.4, one row a file, beside what the text states of its iPhone 5s; and the frames shown, a row
/// for each engine, at rest and turning. A part without a file is left out. Fails if a file is neither.
std::vector<ReportFront> devices_pages(const std::vector<std::string>& files, const Values& figure_4_4);

}  // namespace bihive::cli::thesis
