// The report of bihive compare: one HTML file, without network and scripts.
#pragma once

#include <string>
#include <string_view>

#include "bihive/compare/comparison.h"

namespace bihive {

/// The template: apps/cli/report/comparison.html.
std::string_view comparison_template();

}  // namespace bihive

namespace bihive::cli {

/// A number with about three digits; "-" for NaN.
std::string short_number(double value);

/// The answer in a sentence: which structure is the fastest, and by how much.
std::string answer_of(const workbench::Comparison& comparison);

/// `name` is the name of the input.
std::string comparison_html(const workbench::Comparison& comparison, const std::string& name);
}  // namespace bihive::cli
