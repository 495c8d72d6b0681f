// A comparison as JSON.
#pragma once

#include <string>

#include "bihive/compare/comparison.h"

namespace bihive::workbench {

/// One object over several lines, without a line break at the end, as docs/comparison.schema.json describes it. `name`
/// is the name of the input. Unknown numbers are null.
std::string comparison_json(const Comparison& comparison, const std::string& name);

}  // namespace bihive::workbench
