#include "bihive/select/evaluate.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "bihive/base/parallel.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/bonds.h"
#include "bihive/io/elements.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/select/attribute_names.h"
#include "bihive/select/foreign_words.h"
#include "bihive/select/nearby.h"
#include "bihive/select/number_term.h"
#include "bihive/select/parse_expression.h"
#include "bihive/select/residues.h"
#include "bihive/select/text_values.h"
#include "bihive/select/words.h"

namespace bihive {
namespace {

constexpr std::int64_t kSpheresPerTask = 16384;

bool holds_between(double left, ComparisonSign sign, double right) {
  switch (sign) {
    case ComparisonSign::less:
      return left < right;
    case ComparisonSign::at_most:
      return left <= right;
    case ComparisonSign::more:
      return left > right;
    case ComparisonSign::at_least:
      return left >= right;
    case ComparisonSign::equal:
      return left == right;
    case ComparisonSign::unequal:
      return left < right || left > right;  // NaN is unknown: neither equal nor unequal
  }
  return false;
}

using NumberRange = std::pair<double, double>;  // both ends included

// The ranges of the values in ascending order; those that overlap are one.
std::vector<NumberRange> disjoint_ranges(const std::vector<SelectionValue>& values) {
  std::vector<NumberRange> ranges, merged;
  for (const SelectionValue& value : values) ranges.emplace_back(value.first, value.last);
  std::sort(ranges.begin(), ranges.end());
  for (const NumberRange& range : ranges) {
    if (!merged.empty() && range.first <= merged.back().second)
      merged.back().second = std::max(merged.back().second, range.second);
    else
      merged.push_back(range);
  }
  return merged;
}

bool any_holds(const std::vector<NumberRange>& ranges, double number) {
  // The last range that begins at the number or before it; NaN is in none.
  const auto next = std::upper_bound(ranges.begin(), ranges.end(), number,
                                     [](double n, const NumberRange& range) { return n < range.first; });
  return next != ranges.begin() && number >= std::prev(next)->first && number <= std::prev(next)->second;
}

// The other ends of each sphere's bonds.
class BondedSpheres {
 public:
  BondedSpheres(const std::vector<ImagePair>& bonds, std::size_t spheres)
      : begin_(spheres + 1), other_(2 * bonds.size()) {
    for (const ImagePair& bond : bonds)
      for (const std::int32_t end : bond.pair) ++begin_[static_cast<std::size_t>(end) + 1];
    for (std::size_t i = 0; i < spheres; ++i) begin_[i + 1] += begin_[i];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const ImagePair& bond : bonds)
      for (const int k : {0, 1})
        other_[next[static_cast<std::size_t>(bond.pair[static_cast<std::size_t>(k)])]++] =
            bond.pair[static_cast<std::size_t>(1 - k)];
  }

  std::span<const std::int32_t> of(std::size_t sphere) const {
    return std::span(other_).subspan(begin_[sphere], begin_[sphere + 1] - begin_[sphere]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::int32_t> other_;
};

class Evaluation {
 public:
  Evaluation(std::string_view text, const SphereSet& spheres) : text_(text), spheres_(spheres) {}

  Result<SphereMask> mask_of(const Expression& expression) const {
    switch (expression.kind) {
      case Expression::Kind::word:
        return word(expression);
      case Expression::Kind::values:
        return values(expression);
      case Expression::Kind::comparison:
        return comparison(expression);
      case Expression::Kind::within:
        return within(expression);
      case Expression::Kind::within_bonds:
        return within_bonds(expression);
      case Expression::Kind::bonded:
        return bonded(expression);
      case Expression::Kind::same:
        return same(expression);
      case Expression::Kind::negation:
        return negation(expression);
      case Expression::Kind::conjunction:
      case Expression::Kind::disjunction:
        return joined(expression);
    }
    return error(expression.place, "unknown kind of selection");
  }

 private:
  Error error(TextPlace place, const std::string& what, const std::string& hint = "") const {
    return selection_error(text_, place, what, hint);
  }

  std::size_t size() const { return static_cast<std::size_t>(spheres_.size()); }

  template <class Test>
  SphereMask mask_by(const Test& test) const {
    SphereMask mask(size());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = test(i) ? 1 : 0;
    return mask;
  }

  // A text's spheres, decided once for each distinct text.
  SphereMask mask_by_text(const NamedTexts& column, const std::vector<bool>& wanted) const {
    return mask_by([&](std::size_t i) { return wanted[static_cast<std::size_t>(column.text_of_sphere[i])]; });
  }

  Error unknown_name(TextPlace place, const std::string& name) const {
    return error(place, "there is no attribute " + quote(name), suggestion(name, attribute_names(spheres_)));
  }

  Result<SphereMask> word(const Expression& expression) const {
    const std::string name = lower_case(expression.name);
    if (is_selection_word(name)) {
      const Result<SphereMask> mask = mask_of_word(name, spheres_);
      if (!mask) return error(expression.place, mask.error().message, mask.error().hint);
      return mask;
    }
    const FoundAttribute attribute = find_attribute(spheres_, expression.name);
    if (attribute.found())
      return error(expression.place,
                   quote(expression.name) + " needs " +
                       (attribute.has_numbers() ? "values or a comparison" : "values") + " after it",
                   "for example '" + expression.name + (attribute.has_numbers() ? " > 3'" : " A B'"));
    if (const std::string_view advice = advice_on_foreign_word(expression.name); !advice.empty())
      return error(expression.place, quote(expression.name) + " is a word of another program", std::string(advice));
    std::vector<std::string> names = selection_words();
    for (const std::string& known : attribute_names(spheres_)) names.push_back(known);
    return error(expression.place, "there is no word or attribute " + quote(expression.name),
                 suggestion(expression.name, names));
  }

  Result<SphereMask> values(const Expression& expression) const {
    const FoundAttribute attribute = find_attribute(spheres_, expression.name);
    if (!attribute.found()) {
      if (is_selection_word(lower_case(expression.name)))
        return error(expression.values.front().place, quote(expression.name) + " takes no values",
                     "put 'and' or 'or' after it");
      if (const std::string_view advice = advice_on_foreign_word(expression.name); !advice.empty())
        return error(expression.place, quote(expression.name) + " is a word of another program", std::string(advice));
      return unknown_name(expression.place, expression.name);
    }
    if (Status status = check_for_missing_and(expression); !status) return status.error();
    return values_of(with_lists_apart(expression, attribute), attribute);
  }

  Result<SphereMask> values_of(const Expression& expression, const FoundAttribute& attribute) const {
    if (attribute.is_element()) return elements(expression);

    // A text attribute takes each value as a text. An attribute of both kinds does so where a value is no number.
    const bool any_text = std::any_of(expression.values.begin(), expression.values.end(),
                                      [](const auto& value) { return value.kind == SelectionValue::Kind::text; });
    const bool by_text = attribute.texts != nullptr && (!attribute.has_numbers() || any_text);
    return by_text ? texts(expression, *attribute.texts) : numbers(expression, attribute);
  }

  // PyMOL writes lists as 25+50 and CA+CB. A text that some sphere has is itself.
  Expression with_lists_apart(const Expression& expression, const FoundAttribute& attribute) const {
    Expression apart = expression;
    apart.values.clear();
    for (const SelectionValue& value : expression.values) {
      const bool is_list = value.kind == SelectionValue::Kind::text && !value.quoted && value.text.size() > 2 &&
                           value.text.find('+', 1) < value.text.size() - 1;
      const bool is_text = attribute.texts != nullptr &&
                           std::find(attribute.texts->texts.begin(), attribute.texts->texts.end(), value.text) !=
                               attribute.texts->texts.end();
      if (!is_list || is_text) {
        apart.values.push_back(value);
        continue;
      }
      for (std::size_t begin = 0; begin <= value.text.size();) {
        const std::size_t end = std::min(value.text.find('+', begin), value.text.size());
        apart.values.push_back(value_from(value.text.substr(begin, end - begin), value.place + begin));
        begin = end + 1;
      }
    }
    return apart;
  }

  // "CA", "25" or "10-20".
  static SelectionValue value_from(const std::string& text, TextPlace place) {
    SelectionValue value;
    value.place = place;
    value.text = text;
    const std::size_t minus = text.find('-', 1);
    const std::optional<double> first = parse_double(std::string_view(text).substr(0, minus));
    const std::optional<double> last =
        minus == std::string::npos ? first : parse_double(std::string_view(text).substr(minus + 1));
    if (!first || !last) return value;
    value.kind = minus == std::string::npos ? SelectionValue::Kind::number : SelectionValue::Kind::range;
    value.first = *first;
    value.last = *last;
    return value;
  }

  // 'chain A resname LIG' lacks an 'and': the language could take resname for the name of a chain.
  Status check_for_missing_and(const Expression& expression) const {
    for (std::size_t i = 0; i < expression.values.size(); ++i) {
      const SelectionValue& value = expression.values[i];
      if (value.quoted || value.kind != SelectionValue::Kind::text || value.text.size() < 2) continue;
      if (const std::string_view advice = advice_on_foreign_word(value.text); !advice.empty())
        return error(value.place,
                     quote(value.text) + " is a word of another program, where a value of " + quote(expression.name) +
                         " is expected",
                     std::string(advice) + "; put quotes around it if it is a value");
      const std::vector<std::string> names = attribute_names(spheres_);
      const bool known =
          is_selection_word(value.text) || std::find(names.begin(), names.end(), value.text) != names.end();
      if (known)
        return error(value.place,
                     quote(value.text) + " stands where a value of " + quote(expression.name) + " is expected",
                     "put 'and' or 'or' before it, or quotes around it if it is a value");
    }
    return Done{};
  }

  Status check_range(const SelectionValue& value) const {
    if (value.first <= value.last) return Done{};
    return error(value.place, "the range " + quote(value.text) + " is empty: its first number is above its last");
  }

  Result<SphereMask> elements(const Expression& expression) const {
    std::vector<bool> wanted(256, false);
    for (const SelectionValue& value : expression.values) {
      if (value.kind != SelectionValue::Kind::text) {
        if (Status status = check_range(value); !status) return status.error();
        for (std::size_t number = 0; number < wanted.size(); ++number)
          if (double(number) >= value.first && double(number) <= value.last) wanted[number] = true;
        continue;
      }
      const int number = atomic_number(value.text);
      if (number == 0)
        return error(value.place, quote(value.text) + " is no element",
                     "elements are symbols in upper or lower case (C, fe) or atomic numbers");
      wanted[static_cast<std::size_t>(number)] = true;
    }
    const std::vector<std::uint8_t>& element = spheres_.attributes().element;
    return mask_by([&](std::size_t i) { return wanted[element[i]]; });
  }

  Result<SphereMask> texts(const Expression& expression, const NamedTexts& column) const {
    for (const SelectionValue& value : expression.values)
      if (value.kind == SelectionValue::Kind::range)
        return error(value.place, quote(expression.name) + " holds texts, and a range needs numbers",
                     "put quotes around it if it is a text");
    return mask_by_text(column, texts_that_match(column.texts, expression.values));
  }

  Result<SphereMask> numbers(const Expression& expression, const FoundAttribute& attribute) const {
    for (const SelectionValue& value : expression.values) {
      if (value.kind == SelectionValue::Kind::text)
        return error(value.place, "expected a number for " + quote(expression.name) + ", found " + quote(value.text),
                     "write numbers, or ranges such as 10..20");
      if (Status status = check_range(value); !status) return status.error();
    }
    const std::vector<NumberRange> ranges = disjoint_ranges(expression.values);
    return mask_by(
        [&](std::size_t i) { return any_holds(ranges, attribute.number_of(spheres_, static_cast<std::int64_t>(i))); });
  }

  Result<SphereMask> comparison(const Expression& expression) const {
    if (const auto as_values = comparison_of_texts(expression, spheres_)) {
      Result<SphereMask> mask = values(*as_values);
      if (!mask || expression.signs.front() == ComparisonSign::equal) return mask;
      for (std::uint8_t& byte : *mask) byte = byte == 0 ? 1 : 0;
      return mask;
    }
    std::vector<ResolvedTerm> terms;
    for (const NumberTerm& term : expression.terms) {
      Result<ResolvedTerm> resolved = resolve_term(term, text_, spheres_);
      if (!resolved) return resolved.error();
      terms.push_back(std::move(*resolved));
    }
    return mask_by([&](std::size_t i) {
      double left = terms.front().value(spheres_, static_cast<std::int64_t>(i));
      for (std::size_t k = 0; k < expression.signs.size(); ++k) {
        const double right = terms[k + 1].value(spheres_, static_cast<std::int64_t>(i));
        if (!holds_between(left, expression.signs[k], right)) return false;
        left = right;
      }
      return true;
    });
  }

  Result<SphereMask> within(const Expression& expression) const {
    if (!(expression.distance >= 0)) return error(expression.place, "the distance of 'within' must be at least 0");
    const Result<SphereMask> inner = mask_of(expression.operands.front());
    if (!inner) return inner;
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < size(); ++i)
      if ((*inner)[i] != 0) points.push_back(spheres_.stored_centre(static_cast<std::int64_t>(i)));

    // In stored units: multiplying by a power of two is exact.
    const double distance = expression.distance * spheres_.scale();
    std::optional<Lattice> lattice = Lattice::of(spheres_.cell());
    if (lattice) lattice = lattice->times(spheres_.scale());
    for (std::int64_t id = 0; lattice && id < spheres_.size(); ++id)
      if (!lattice->holds(spheres_.stored_centre(id))) lattice.reset();
    const NearbyPoints nearby(std::move(points), lattice);
    SphereMask mask(size());
    const std::int64_t tasks = (spheres_.size() + kSpheresPerTask - 1) / kSpheresPerTask;
    parallel_for(0, tasks, [&](std::int64_t task) {
      const std::int64_t end = std::min(spheres_.size(), (task + 1) * kSpheresPerTask);
      for (std::int64_t id = task * kSpheresPerTask; id < end; ++id)
        mask[static_cast<std::size_t>(id)] = nearby.any_within(spheres_.stored_centre(id), distance) ? 1 : 0;
    });
    return mask;
  }

  // The spheres that each sphere is bonded to, by the bonds that sticks would be drawn for; found once.
  Result<const BondedSpheres*> bonds(TextPlace place) const {
    if (!bonds_) {
      const Result<std::vector<ImagePair>> found = automatic_bonds(spheres_, kUsualBondReach);
      if (!found) return error(place, found.error().message, found.error().hint);
      bonds_.emplace(*found, size());
    }
    return &*bonds_;
  }

  Result<SphereMask> bonded(const Expression& expression) const {
    const Result<const BondedSpheres*> bonds_of = bonds(expression.place);
    if (!bonds_of) return bonds_of.error();
    const Result<SphereMask> inner = mask_of(expression.operands.front());
    if (!inner) return inner;
    SphereMask mask(size());
    for (std::size_t i = 0; i < size(); ++i)
      if ((*inner)[i] != 0)
        for (const std::int32_t other : (*bonds_of)->of(i)) mask[static_cast<std::size_t>(other)] = 1;
    return mask;
  }

  // Bond by bond outward, from each sphere once.
  Result<SphereMask> within_bonds(const Expression& expression) const {
    if (!(expression.distance >= 0) || expression.distance != std::floor(expression.distance))
      return error(expression.place, "the number of bonds of 'within' must be a whole number, at least 0");
    const Result<const BondedSpheres*> bonds_of = bonds(expression.place);
    if (!bonds_of) return bonds_of.error();
    Result<SphereMask> mask = mask_of(expression.operands.front());
    if (!mask) return mask;
    std::vector<std::int32_t> last, next;
    for (std::size_t i = 0; i < size(); ++i)
      if ((*mask)[i] != 0) last.push_back(static_cast<std::int32_t>(i));
    for (double step = 0; step < expression.distance && !last.empty(); ++step) {
      next.clear();
      for (const std::int32_t sphere : last)
        for (const std::int32_t other : (*bonds_of)->of(static_cast<std::size_t>(sphere)))
          if (std::exchange((*mask)[static_cast<std::size_t>(other)], std::uint8_t{1}) == 0) next.push_back(other);
      last.swap(next);
    }
    return mask;
  }

  Result<SphereMask> same(const Expression& expression) const {
    const Result<SphereMask> inner = mask_of(expression.operands.front());
    if (!inner) return inner;
    if (lower_case(expression.name) == "residue") {
      const Result<std::vector<std::int32_t>> residue = residue_of_spheres(spheres_);
      if (!residue) return error(expression.place, residue.error().message, residue.error().hint);
      std::vector<bool> wanted(residue->empty() ? 0 : static_cast<std::size_t>(residue->back()) + 1, false);
      for (std::size_t i = 0; i < size(); ++i)
        if ((*inner)[i] != 0) wanted[static_cast<std::size_t>((*residue)[i])] = true;
      return mask_by([&](std::size_t i) { return wanted[static_cast<std::size_t>((*residue)[i])]; });
    }
    const FoundAttribute attribute = find_attribute(spheres_, expression.name);
    if (!attribute.found()) return unknown_name(expression.place, expression.name);
    if (!attribute.has_numbers()) {
      std::vector<bool> wanted(attribute.texts->texts.size(), false);
      for (std::size_t i = 0; i < size(); ++i)
        if ((*inner)[i] != 0) wanted[static_cast<std::size_t>(attribute.texts->text_of_sphere[i])] = true;
      return mask_by_text(*attribute.texts, wanted);
    }
    const auto number = [&](std::size_t i) { return attribute.number_of(spheres_, static_cast<std::int64_t>(i)); };
    std::vector<double> wanted;
    for (std::size_t i = 0; i < size(); ++i)
      if ((*inner)[i] != 0 && !std::isnan(number(i))) wanted.push_back(number(i));
    std::sort(wanted.begin(), wanted.end());
    return mask_by([&](std::size_t i) {
      return !std::isnan(number(i)) && std::binary_search(wanted.begin(), wanted.end(), number(i));
    });
  }

  Result<SphereMask> negation(const Expression& expression) const {
    Result<SphereMask> mask = mask_of(expression.operands.front());
    if (!mask) return mask;
    for (std::uint8_t& byte : *mask) byte = byte == 0 ? 1 : 0;
    return mask;
  }

  Result<SphereMask> joined(const Expression& expression) const {
    const bool both = expression.kind == Expression::Kind::conjunction;
    Result<SphereMask> mask = mask_of(expression.operands.front());
    for (std::size_t k = 1; mask && k < expression.operands.size(); ++k) {
      const Result<SphereMask> other = mask_of(expression.operands[k]);
      if (!other) return other;
      for (std::size_t i = 0; i < size(); ++i) {
        const bool left = (*mask)[i] != 0, right = (*other)[i] != 0;
        (*mask)[i] = (both ? left && right : left || right) ? 1 : 0;
      }
    }
    return mask;
  }

  std::string_view text_;
  const SphereSet& spheres_;
  mutable std::optional<BondedSpheres> bonds_;
};

}  // namespace

Result<SphereMask> evaluate(const Expression& expression, std::string_view text, const SphereSet& spheres) {
  return Evaluation(text, spheres).mask_of(expression);
}

}  // namespace bihive
