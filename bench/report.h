// What was measured, for people and for machines.
#pragma once

#include <string>

#include "measure.h"

namespace bihive::bench {

/// One JSON object. What was not measured is null.
std::string json_report(const Measured& measured, const BenchOptions& options);
std::string text_report(const Measured& measured, const BenchOptions& options);

}  // namespace bihive::bench
