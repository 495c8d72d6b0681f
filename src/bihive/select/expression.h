// The tree of a selection: what the grammar found in the text, before any set of spheres is known.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bihive {

/// A place in the selection's text: bytes from 0.
using TextPlace = std::size_t;

/// Arithmetic on numbers: `2 * x + sqrt(charge)`.
struct NumberTerm {
  enum class Kind { number, name, negative, chain, power, square_root, absolute };
  Kind kind = Kind::number;
  TextPlace place = 0;
  std::string text;  ///< a number as it is written, or a name
  double number = 0;
  std::vector<NumberTerm> operands;
  std::string signs;  ///< of a chain: + - or * / between each two operands, taken from left to right
};

/// One of the values behind a name: `CA`, `7`, `10..20`.
struct SelectionValue {
  enum class Kind { text, number, range };
  Kind kind = Kind::text;
  TextPlace place = 0;
  std::string text;  ///< as it is written, without quotes; a number is also a text
  bool quoted = false;
  double first = 0, last = 0;  ///< of a range, both included; of a number both are the number
};

enum class ComparisonSign { less, at_most, more, at_least, equal, unequal };

struct Expression {
  enum class Kind {
    word,          ///< `name` alone: all, water ...
    values,        ///< `name` with `values`
    comparison,    ///< `terms` with a sign between each two
    within,        ///< at most `distance` from a sphere of the operand
    within_bonds,  ///< at most `distance` bonds from a sphere of the operand
    bonded,        ///< to a sphere of the operand
    same,          ///< those whose `name` (an attribute, or "residue") some sphere of the operand has too
    negation,      ///< of the operand
    conjunction,   ///< all operands
    disjunction    ///< any operand
  };
  Kind kind = Kind::word;
  TextPlace place = 0;
  std::string name;
  std::vector<SelectionValue> values;
  std::vector<NumberTerm> terms;
  std::vector<ComparisonSign> signs;
  double distance = 0;
  std::vector<Expression> operands;
};

}  // namespace bihive
