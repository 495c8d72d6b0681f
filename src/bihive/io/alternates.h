// Alternate locations: where a structure gives several places for one atom, the likeliest stays.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Told of every atom that has an alternate-location mark, it finds those that are to go: of one site the highest
/// occupancy stays, of equal ones the first. A site whose mark comes a second time is taken for another site (files of
/// simulations count residues round and round).
class Alternates {
 public:
  /// `site` stands for chain, residue and atom name; `mark` is never blank; `index` is the atom's position in file
  /// order.
  void add(const std::string& site, char mark, double occupancy, std::size_t index);

  std::size_t sites() const { return sites_.size(); }
  /// Takes the atoms out that are to go; the others keep their order.
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
