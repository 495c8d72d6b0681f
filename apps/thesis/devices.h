// Measurements of other devices: runs of Figure 4.4 and frames shown per second, in files saved by the page's "Run the
// thesis on this device" and, for the window, by scripts/shown_frames.
#pragma once

#include <string>
#include <vector>

#include "experiment.h"

namespace bihive::thesis {

/// {"runs": [...], "shown": [...]}; a part without a file is left out. Runs are beside what the text states of its
/// phone in the report. Fails if a file is neither.
Json devices_data(const std::vector<std::string>& files, const Values& figure_4_4);

}  // namespace bihive::thesis
