// Alternate locations: a structure may give several places for one atom. The likeliest place stays.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Takes every atom with an alternate-location mark, and finds the atoms to remove. The highest occupancy of a site
/// stays; of equal ones the first. A mark that comes a second time begins another site, because files of simulations
/// use residue numbers again and again.
class Alternates {
 public:
  /// `site` stands for chain, residue and atom name; `mark` is never blank; `index` is the atom's position in file
  /// order.
  void add(const std::string& site, char mark, double occupancy, std::size_t index);

  std::size_t sites() const { return sites_.size(); }
  /// Removes these atoms; the others keep their order.
  void remove_from(RawSpheres& spheres) const;

 private:
  struct Site {
    std::string marks;
    double occupancy;
    std::size_t index;
  };
  std::unordered_map<std::string, Site> sites_;
  std::vector<std::size_t> removed_;
};

}  // namespace bihive
