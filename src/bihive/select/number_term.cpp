#include "bihive/select/number_term.h"

#include <utility>

#include "bihive/io/text_scanner.h"
#include "bihive/select/parse_expression.h"

namespace bihive {

double ResolvedTerm::value(const SphereSet& spheres, std::int64_t id) const {
  const auto operand = [&](std::size_t i) { return operands[i].value(spheres, id); };
  switch (kind) {
    case NumberTerm::Kind::number:
      return number;
    case NumberTerm::Kind::name:
      return attribute.number_of(spheres, id);
    case NumberTerm::Kind::negative:
      return -operand(0);
    case NumberTerm::Kind::sum:
      return operand(0) + operand(1);
    case NumberTerm::Kind::difference:
      return operand(0) - operand(1);
    case NumberTerm::Kind::product:
      return operand(0) * operand(1);
    case NumberTerm::Kind::quotient:
      return operand(0) / operand(1);
  }
  return 0;
}

Result<ResolvedTerm> resolve_term(const NumberTerm& term, std::string_view text, const SphereSet& spheres) {
  ResolvedTerm resolved;
  resolved.kind = term.kind;
  resolved.number = term.number;
  if (term.kind == NumberTerm::Kind::name) {
    resolved.attribute = find_attribute(spheres, term.text);
    if (!resolved.attribute.found())
      return selection_error(text, term.place, "there is no attribute " + quote(term.text),
                             suggestion(term.text, attribute_names(spheres)));
    if (!resolved.attribute.has_numbers())
      return selection_error(text, term.place, quote(term.text) + " holds texts, and this comparison needs numbers",
                             "list the wanted texts behind its name: '" + term.text + " A B'");
  }
  for (const NumberTerm& operand : term.operands) {
    Result<ResolvedTerm> one = resolve_term(operand, text, spheres);
    if (!one) return one;
    resolved.operands.push_back(std::move(*one));
  }
  return resolved;
}

}  // namespace bihive
