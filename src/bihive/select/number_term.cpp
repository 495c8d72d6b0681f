#include "bihive/select/number_term.h"

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
