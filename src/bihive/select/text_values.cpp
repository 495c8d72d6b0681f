#include "bihive/select/text_values.h"

#include <algorithm>
#include <string_view>

#include "bihive/io/elements.h"
#include "bihive/select/attribute_names.h"

namespace bihive {
namespace {

// Whether the text fits a pattern in which `*` stands for any characters.
bool fits(std::string_view text, std::string_view pattern) {
  std::size_t t = 0, p = 0, after_star = std::string_view::npos, retry = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_star = ++p;
      retry = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (after_star != std::string_view::npos) {
      p = after_star;
      t = ++retry;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

bool matches(const std::string& text, const SelectionValue& value) {
  return value.quoted ? text == value.text : fits(text, value.text);
}

// Whether texts stand for the values of this name: of a text alone, or of the element.
bool takes_texts(const NumberTerm& term, const SphereSet& spheres) {
  if (term.kind != NumberTerm::Kind::name) return false;
  const FoundAttribute attribute = find_attribute(spheres, term.text);
  return attribute.is_element() || (attribute.texts != nullptr && !attribute.has_numbers());
}

}  // namespace

std::vector<bool> texts_that_match(const std::vector<std::string>& texts, const std::vector<SelectionValue>& values) {
  std::vector<bool> answers;
  answers.reserve(texts.size());
  for (const std::string& text : texts)
    answers.push_back(std::any_of(values.begin(), values.end(),
                                  [&text](const SelectionValue& value) { return matches(text, value); }));
  return answers;
}

std::optional<Expression> comparison_of_texts(const Expression& comparison, const SphereSet& spheres) {
  if (comparison.terms.size() != 2) return std::nullopt;
  const ComparisonSign sign = comparison.signs.front();
  if (sign != ComparisonSign::equal && sign != ComparisonSign::unequal) return std::nullopt;
  const NumberTerm& name = comparison.terms[0];
  const NumberTerm& value = comparison.terms[1];
  if (!takes_texts(name, spheres)) return std::nullopt;
  if (value.kind != NumberTerm::Kind::name && value.kind != NumberTerm::Kind::number) return std::nullopt;

  Expression made;
  made.kind = Expression::Kind::values;
  made.place = name.place;
  made.name = name.text;
  SelectionValue one;
  one.kind = value.kind == NumberTerm::Kind::number ? SelectionValue::Kind::number : SelectionValue::Kind::text;
  one.place = value.place;
  one.text = value.text;
  one.quoted = true;
  one.first = one.last = value.number;
  made.values.push_back(one);
  return made;
}

}  // namespace bihive
