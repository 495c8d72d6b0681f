#include "bihive/io/formats/molecules/cif_elements.h"

#include <algorithm>
#include <cstddef>

#include "bihive/base/ascii.h"
#include "bihive/io/elements.h"

namespace bihive {
namespace {

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

std::string_view first_letters(std::string_view text) {
  return text.substr(0, static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_letter) - text.begin()));
}

// Symbols of two letters that are more frequent in molecules than the first letter's element with another letter.
bool is_frequent_pair(int element) {
  constexpr int kFrequent[] = {14, 17, 26, 34, 35, 78};  // Si, Cl, Fe, Se, Br, Pt
  return std::find(std::begin(kFrequent), std::end(kFrequent), element) != std::end(kFrequent);
}

}  // namespace

int element_of_type_symbol(std::string_view symbol) {
  const std::string_view letters = first_letters(symbol);
  std::string_view charge = symbol.substr(letters.size());
  const bool has_sign = !charge.empty() && (charge.back() == '+' || charge.back() == '-');
  if (has_sign) charge.remove_suffix(1);
  const bool is_charge = std::all_of(charge.begin(), charge.end(), is_digit) && (has_sign || charge.empty());
  return is_charge ? atomic_number(letters) : 0;
}

void LabelElements::add_formula(std::string_view formula) {
  while (!formula.empty()) {
    const std::string_view letters = first_letters(formula);
    // Without blanks the capitals begin the symbols; a formula may be in capitals, too.
    if (const int whole = atomic_number(letters)) stated_.set(static_cast<std::size_t>(whole));
    for (std::size_t at = 0; at < letters.size();) {
      const std::size_t length = at + 1 < letters.size() && !is_capital(letters[at + 1]) ? 2 : 1;
      if (const int part = atomic_number(letters.substr(at, length))) stated_.set(static_cast<std::size_t>(part));
      at += length;
    }
    formula.remove_prefix(std::max<std::size_t>(letters.size(), 1));
  }
}

void LabelElements::add_type_symbol(std::string_view symbol) {
  if (const int element = element_of_type_symbol(symbol)) stated_.set(static_cast<std::size_t>(element));
}

int LabelElements::of(std::string_view label) {
  const std::string_view letters = first_letters(label).substr(0, 2);
  const int one = atomic_number(letters.substr(0, 1));
  const int two = letters.size() == 2 ? atomic_number(letters) : 0;
  if (one == 0 || two == 0) return one + two;
  const bool states_one = stated_.test(static_cast<std::size_t>(one)),
             states_two = stated_.test(static_cast<std::size_t>(two));
  if (states_one != states_two) return states_one ? one : two;
  if (!is_capital(letters[1]) || is_frequent_pair(two) || states_two) return two;
  has_guessed_ = true;
  return one;
}

}  // namespace bihive
