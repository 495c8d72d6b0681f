#include "bihive/select/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/geometry/lattice.h"
#include "bihive/io/elements.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/select/attribute_names.h"
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

namespace {

constexpr std::size_t kMostTexts = 12;

// Of a name without spheres that have one of its values.
std::string alternatives_to(const SphereSet& spheres, const Expression& test) {
  const FoundAttribute attribute = find_attribute(spheres, test.name);
  std::string values;
  for (const SelectionValue& value : test.values)
    values += (values.empty() ? "" : " ") + (value.quoted ? quote(value.text) : value.text);
  const std::string nothing = "no sphere has " + test.name + " " + values + "; there ";
  if (attribute.texts != nullptr) {
    // A frame's texts are numbered with those of other frames.
    std::vector<std::string> texts;
    std::vector<bool> is_used(attribute.texts->texts.size(), false);
    for (const std::int32_t text : attribute.texts->text_of_sphere) is_used[static_cast<std::size_t>(text)] = true;
    for (std::size_t i = 0; i < is_used.size(); ++i)
      if (is_used[i]) texts.push_back(attribute.texts->texts[i]);
    std::string list;
    for (std::size_t i = 0; i < std::min(texts.size(), kMostTexts); ++i)
      list += (i == 0 ? "" : ", ") + (texts[i].empty() ? quote("") : printable(texts[i]));
    if (texts.size() > kMostTexts) list += " and " + std::to_string(texts.size() - kMostTexts) + " others";
    return nothing + "are " + list;
  }
  if (attribute.is_element()) {
    std::vector<bool> is_there(256, false);
    for (std::int64_t id = 0; id < spheres.size(); ++id)
      is_there[static_cast<std::size_t>(attribute.number_of(spheres, id))] = true;
    std::string list;
    for (std::size_t number = 1; number < is_there.size(); ++number)
      if (is_there[number]) list += (list.empty() ? "" : ", ") + element_symbol(static_cast<int>(number));
    return list.empty() ? list : nothing + "are " + list;
  }
  double low = 0, high = 0;
  bool any = false;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const double number = attribute.number_of(spheres, id);
    if (!std::isfinite(number)) continue;
    low = any ? std::min(low, number) : number;
    high = any ? std::max(high, number) : number;
    any = true;
  }
  return any ? nothing + fmt::format("are numbers from {} to {}", low, high) : std::string();
}

std::string first_empty_test(const SphereSet& spheres, const Expression& expression, std::string_view text) {
  if (expression.kind == Expression::Kind::values) {
    const Result<std::vector<std::uint8_t>> mask = evaluate(expression, text, spheres);
    const bool found = !mask || std::find(mask->begin(), mask->end(), std::uint8_t{1}) != mask->end();
    return found ? std::string() : alternatives_to(spheres, expression);
  }
  for (const Expression& operand : expression.operands)
    if (std::string reason = first_empty_test(spheres, operand, text); !reason.empty()) return reason;
  return "";
}

bool has_distance(const Expression& expression) {
  using Kind = Expression::Kind;
  return expression.kind == Kind::within || expression.kind == Kind::within_bonds || expression.kind == Kind::bonded ||
         std::any_of(expression.operands.begin(), expression.operands.end(), has_distance);
}

}  // namespace

bool sees_images(const SphereSet& spheres, std::string_view expression) {
  const Result<Expression> parsed = parse_expression(expression);
  return parsed && has_distance(*parsed) && Lattice::of(spheres.cell());
}

std::string what_there_is(const SphereSet& spheres, std::string_view expression) {
  const Result<Expression> parsed = parse_expression(expression);
  return parsed ? first_empty_test(spheres, *parsed, expression) : std::string();
}

std::string caret_lines(std::string_view expression, const Error& error) {
  if (error.column == 0 || error.line == 0) return "";
  for (std::int64_t line = 1; line < error.line; ++line)
    expression.remove_prefix(std::min(expression.find('\n'), expression.size() - 1) + 1);
  const std::string line = printable(expression.substr(0, expression.find('\n')));
  return "  " + line + "\n  " + std::string(static_cast<std::size_t>(error.column - 1), ' ') + "^\n";
}

}  // namespace bihive
