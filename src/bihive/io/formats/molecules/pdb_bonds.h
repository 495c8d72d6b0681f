// The bonds of PDB files: CONECT [wwPDB-3.3].
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Takes CONECT records one after the other.
class PdbBonds {
 public:
  /// A record that does not keep to its columns is read as fields between blanks; what is no number ends it.
  void add_line(std::string_view line);
  /// Bonds between spheres by their column `serial`. A bond to a serial number that no sphere or several have counts as
  /// none. Of a bond that one atom states two or three times that is the order.
  void take(RawSpheres& spheres);

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs_;  // serial numbers
};

}  // namespace bihive
