// The report of bihive compare: one HTML file, without network and scripts.
#pragma once

#include <string>
#include <string_view>

#include "bihive/compare/comparison.h"
#include "bihive/compare/sweep.h"

namespace bihive {

/// The template: apps/cli/report/comparison.html.
std::string_view comparison_template();

}  // namespace bihive

namespace bihive::cli {

/// `name` is the name of the input.
std::string comparison_html(const workbench::Comparison& comparison, const std::string& name);
std::string sweep_html(const workbench::Sweep& sweep, const std::string& name);

}  // namespace bihive::cli
