// Values of a frame for the title of its picture, from a table of the user's.
#pragma once

#include <cstdint>
#include <string>

#include "bihive/scene/title_text.h"

namespace bihive {

/// The columns of row `frame` (from 0, after the line of names) of a CSV file; an empty field is unknown (NaN). Fails
/// with kBadInput on a file without that row, a field that is not a number, or a name that occurs twice.
TitleValues values_of_frame(const std::string& path, std::int64_t frame);

}  // namespace bihive
