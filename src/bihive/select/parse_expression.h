// From a selection's text to its tree. docs/selections.md has the grammar.
#pragma once

#include <string_view>

#include "bihive/base/result.h"
#include "bihive/select/expression.h"

namespace bihive {

/// The longest text; the deepest nesting of parentheses, and the most 'within'. So the tree is never so deep that a
/// recursion over it could fail.
constexpr std::size_t kLongestSelection = 65536;
constexpr int kDeepestSelection = 100;

/// An error has the line and the column (in characters) of the place that does not fit, and says what was expected.
Result<Expression> parse_expression(std::string_view text);

/// The same of arithmetic alone: "sqrt(vx^2 + vy^2)".
Result<NumberTerm> parse_number_term(std::string_view text);

/// An error at a place of the text.
Error selection_error(std::string_view text, TextPlace place, const std::string& message, const std::string& hint = "");

}  // namespace bihive
