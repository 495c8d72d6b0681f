// The elements of atoms in CIF and mmCIF: type symbols with charges, labels, and the formula that tells labels apart.
#pragma once

#include <bitset>
#include <string_view>

namespace bihive {

/// The atomic number of a type symbol: "C", "FE", "Fe3+", "O2-", "N1+"; 0 if it is no symbol with a charge or without.
int element_of_type_symbol(std::string_view symbol);

/// Elements of labels such as C12, Cl1A and HO1.
class LabelElements {
 public:
  /// The elements that the file states: a formula ("C10 H12 Cl2 O"), or one type symbol.
  void add_formula(std::string_view formula);
  void add_type_symbol(std::string_view symbol);

  /// The atomic number, 0 if the label begins with no symbol. If only one reading of its first letters is an element
  /// that the file states, it is that. Else a second letter belongs to the symbol if it is small, or if the symbol is
  /// BR, CL, FE, PT, SE or SI: CA1 is carbon, Ca1 calcium.
  int of(std::string_view label);
  /// Whether a label in capitals had two readings, of which the first letter alone was taken by that rule.
  bool has_guessed() const { return has_guessed_; }

 private:
  std::bitset<119> stated_;
  bool has_guessed_ = false;
};

}  // namespace bihive
