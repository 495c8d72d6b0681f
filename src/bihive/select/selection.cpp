#include "bihive/select/selection.h"

#include <algorithm>

#include "bihive/io/text/text_scanner.h"
#include "bihive/select/evaluate.h"
#include "bihive/select/parse_expression.h"

namespace bihive {

Result<std::vector<std::uint8_t>> select_spheres(const SphereSet& spheres, std::string_view expression) {
  const Result<Expression> parsed = parse_expression(expression);
  if (!parsed) return parsed.error();
  return evaluate(*parsed, expression, spheres);
}

Status check_selection(std::string_view expression) {
  const Result<Expression> parsed = parse_expression(expression);
  if (!parsed) return parsed.error();
  return Done{};
}

std::string caret_lines(std::string_view expression, const Error& error) {
  if (error.column == 0 || error.line == 0) return "";
  for (std::int64_t line = 1; line < error.line; ++line)
    expression.remove_prefix(std::min(expression.find('\n'), expression.size() - 1) + 1);
  const std::string line = printable(expression.substr(0, expression.find('\n')));
  return "  " + line + "\n  " + std::string(static_cast<std::size_t>(error.column - 1), ' ') + "^\n";
}

}  // namespace bihive
