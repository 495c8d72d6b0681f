#include "bihive/select/number_term.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bihive/io/text/text_scanner.h"
#include "bihive/math/elementary.h"
#include "bihive/select/parse_expression.h"

namespace bihive {
namespace {

// x^y with the same bits on every platform; NaN where there is no real number.
double power_of(double x, double y) {
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  if (is_small_whole(std::abs(y))) {
    double product = 1, factor = x;
    for (int left = static_cast<int>(std::abs(y)); left > 0; left /= 2, factor *= factor)
      if (left % 2 == 1) product *= factor;
    return y < 0 ? 1 / product : product;
  }
  if (x < 0 || !std::isfinite(x) || !std::isfinite(y)) return std::numeric_limits<double>::quiet_NaN();
  return y < 0 ? 1 / portable_pow(x, -y) : portable_pow(x, y);
}

}  // namespace

double ResolvedTerm::value(const SphereSet& spheres, std::int64_t id) const {
  if (kind == NumberTerm::Kind::number) return number;
  if (kind == NumberTerm::Kind::name) return attribute.number_of(spheres, id);
  double result = operands.front().value(spheres, id);
  if (kind == NumberTerm::Kind::negative) return -result;
  if (kind == NumberTerm::Kind::absolute) return std::abs(result);
  if (kind == NumberTerm::Kind::square_root) return std::sqrt(result);
  if (kind == NumberTerm::Kind::power) return power_of(result, operands[1].value(spheres, id));
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const double right = operands[i + 1].value(spheres, id);
    if (signs[i] == '+') result += right;
    if (signs[i] == '-') result -= right;
    if (signs[i] == '*') result *= right;
    if (signs[i] == '/') result /= right;
  }
  return result;
}

bool ResolvedTerm::differs_by_image() const {
  if (kind == NumberTerm::Kind::name) return attribute.differs_by_image();
  return std::any_of(operands.begin(), operands.end(), [](const ResolvedTerm& one) { return one.differs_by_image(); });
}

Result<FoundAttribute> find_numbers(const SphereSet& spheres, std::string_view text) {
  if (FoundAttribute attribute = find_attribute(spheres, text); attribute.found()) return attribute;
  const Result<NumberTerm> term = parse_number_term(text);
  const auto in_one_line = [text](Error error) {
    if (error.column > 0)
      error.message = quote(text) + ": column " + std::to_string(error.column) + ": " + error.message;
    error.line = error.column = 0;
    return error;
  };
  if (!term || term->kind == NumberTerm::Kind::name || term->kind == NumberTerm::Kind::number) {
    const bool is_arithmetic = text.find_first_of("+*/^()") != std::string_view::npos;
    if (!term && is_arithmetic) return in_one_line(term.error());
    return Error{"there is no attribute \"" + std::string(text) + "\"", "", 0, 0,
                 suggestion(text, attribute_names(spheres))};
  }
  Result<ResolvedTerm> resolved = resolve_term(*term, text, spheres);
  if (!resolved) return in_one_line(resolved.error());
  FoundAttribute found;
  found.number = FoundAttribute::Number::expression;
  found.term = std::make_shared<const ResolvedTerm>(std::move(*resolved));
  return found;
}

Result<ResolvedTerm> resolve_term(const NumberTerm& term, std::string_view text, const SphereSet& spheres) {
  ResolvedTerm resolved;
  resolved.kind = term.kind;
  resolved.number = term.number;
  resolved.signs = term.signs;
  if (term.kind == NumberTerm::Kind::name) {
    resolved.attribute = find_attribute(spheres, term.text);
    if (!resolved.attribute.found())
      return selection_error(text, term.place, "there is no attribute " + quote(term.text),
                             suggestion(term.text, attribute_names(spheres)));
    if (!resolved.attribute.has_numbers())
      return selection_error(text, term.place, quote(term.text) + " holds texts, and this comparison needs numbers",
                             "list the wanted texts after its name: '" + term.text + " A B'");
  }
  for (const NumberTerm& operand : term.operands) {
    Result<ResolvedTerm> one = resolve_term(operand, text, spheres);
    if (!one) return one;
    resolved.operands.push_back(std::move(*one));
  }
  return resolved;
}

}  // namespace bihive
