// The named columns of the atoms in PDB and mmCIF files: what selections ask for.
#pragma once

#include <string_view>

#include "bihive/io/raw_spheres.h"

namespace bihive {

/// What a file says of one atom beyond its place. An empty text: not said.
struct AtomNames {
  std::string_view record;  ///< "ATOM" or "HETATM"
  std::string_view serial;  ///< the atom's number, as text; it need not be a number
  std::string_view chain;
  std::string_view residue_number;  ///< as text; it need not be a number
  std::string_view insertion;       ///< the code behind the residue's number
  std::string_view residue;         ///< the residue's name
  std::string_view name;            ///< the atom's
  std::string_view entity;          ///< mmCIF alone
};

/// Takes the atoms one after the other.
class AtomColumns {
 public:
  void add(const AtomNames& names, double occupancy, double b_factor);

  /// Gives the columns to the spheres: the numbers occupancy, b_factor and resid (NaN where the residue's number is no
  /// whole number), the texts record, chain, resname and name; serial, insertion and entity where any atom has one.
  void take(SphereAttributes& attributes);

 private:
  NamedNumbers occupancy_{"occupancy", {}}, b_factor_{"b_factor", {}}, residue_number_{"resid", {}},
      serial_{"serial", {}};
  bool has_serials_ = false;
  TextCollector record_, chain_, residue_, name_, insertion_, entity_;
};

}  // namespace bihive
