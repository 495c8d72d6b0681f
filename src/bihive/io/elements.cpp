#include "bihive/io/elements.h"

#include <cmath>
#include <gemmi/elem.hpp>

namespace bihive {

int atomic_number(std::string_view symbol) {
  // gemmi looks at two characters only, and takes a blank as a part of a symbol, so check them first.
  if (symbol.empty() || symbol.size() > 2) return 0;
  char text[3] = {0, 0, 0};
  for (std::size_t i = 0; i < symbol.size(); ++i) {
    const char c = symbol[i];
    if (!((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'))) return 0;
    text[i] = c;
  }
  return gemmi::Element(text).atomic_number();
}

std::string element_symbol(int atomic_number) {
  if (atomic_number < 1 || atomic_number > 118) return "";
  return gemmi::Element(atomic_number).name();
}

int element_of_mass(double mass) {
  constexpr double kTolerance = 0.05;
  for (int number = 1; number <= 118; ++number)
    if (std::abs(gemmi::Element(number).weight() - mass) <= kTolerance) return number;
  return 0;
}

double van_der_waals_radius(int atomic_number) {
  if (atomic_number < 1 || atomic_number > 118) return 0;
  return double(gemmi::Element(atomic_number).vdw_r());
}

double covalent_radius(int atomic_number) {
  if (atomic_number < 1 || atomic_number > 118) return 0;
  return double(gemmi::Element(atomic_number).covalent_r());
}

}  // namespace bihive
