// Chemical elements: symbols, atomic numbers, van der Waals and covalent radii.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// The atomic number, 1 to 118, of a symbol in upper or lower case ("C", "cl", "FE"; D is hydrogen), or 0.
int atomic_number(std::string_view symbol);

/// "C", "Cl"; empty if the number is not 1 to 118.
std::string element_symbol(int atomic_number);

/// The atomic number of the element whose atomic weight, from gemmi's table, differs from this mass by at most 0.05, or
/// 0.
int element_of_mass(double mass);

/// Van der Waals radius in Angstrom, from gemmi's table; 0 if the number is not 1 to 118.
double van_der_waals_radius(int atomic_number);

/// Covalent radius of a single bond in Angstrom [Cordero2008], from gemmi's table; 0 if the number is not 1 to 118.
double covalent_radius(int atomic_number);

}  // namespace bihive
