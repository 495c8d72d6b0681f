// Reports of the measurements, as text and as JSON.
#pragma once

#include <string>

#include "measure.h"

namespace bihive::bench {

/// One JSON object. Missing measurements are null.
std::string json_report(const Measured& measured, const BenchOptions& options);
std::string text_report(const Measured& measured, const BenchOptions& options);

}  // namespace bihive::bench
