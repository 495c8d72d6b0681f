// JSON of bihive compare and bihive tune: docs/comparison.schema.json, docs/sweep.schema.json,
// docs/tuning.schema.json and docs/ray_paths.schema.json describe the objects.
#pragma once

#include <string>
#include <vector>

#include "bihive/compare/comparison.h"
#include "bihive/compare/ray_path.h"
#include "bihive/compare/sweep.h"
#include "bihive/compare/tune.h"

namespace bihive::workbench {

/// `name` is that of the input.
std::string comparison_json(const Comparison& comparison, const std::string& name);
std::string sweep_json(const Sweep& sweep, const std::string& name);
std::string tuning_json(const Tuning& tuning, const std::string& name);
std::string ray_paths_json(const std::vector<StructurePath>& paths, const std::string& name);

}  // namespace bihive::workbench
