// Alternate locations: a structure may give several places for one atom, and several residues for one place in the
// chain (microheterogeneity). The likeliest stays.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bihive/io/raw_spheres.h"

namespace bihive {

/// The names of an atom with an alternate-location mark.
struct AlternateAtom {
  std::string residue;         ///< chain, residue number, insertion code
  std::string_view component;  ///< the residue's name: it differs within one residue if that is heterogeneous
  std::string_view name;       ///< the atom's
  char mark;                   ///< never blank
  double occupancy;
};

/// Takes every atom with an alternate-location mark, and finds the atoms to remove. The highest occupancy of a site
/// stays; of equal ones the first. A mark that comes a second time begins another site, because files of simulations
/// use residue numbers again and again.
///
/// A residue whose marks stand for residues of different names keeps one of them as a whole: the name and mark with
/// the highest mean occupancy, of equal ones the first.
class Alternates {
 public:
  /// `index` is the atom's position in file order.
  void add(const AlternateAtom& atom, std::size_t index);

  /// Removes these atoms; the others keep their order.
  void remove_from(RawSpheres& spheres) const;

 private:
  struct Atom {
    std::size_t residue, component, name;  // numbers of the names
    char mark;
    double occupancy;
    std::size_t index;
  };
  struct Conformer {
    std::size_t component;
    char mark;
    double occupancy_sum;
    double atoms;
  };

  std::size_t number_of(std::string_view name);
  std::size_t drop_components(std::vector<std::uint8_t>& kept, std::vector<Atom>& left) const;

  std::unordered_map<std::string, std::size_t> numbers_;
  std::vector<Atom> atoms_;
};

}  // namespace bihive
