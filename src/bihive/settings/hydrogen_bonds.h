// Hydrogen bonds drawn as dashes.
#pragma once

#include "bihive/math/vec3.h"

namespace bihive {

struct HydrogenBonds {
  bool shown = false;             ///< those that find_hydrogen_bonds() finds (scene/hydrogen_bonds.h)
  double radius = 0.06;           ///< of the dashes in world units (Å), above 0
  Vec3d colour{0.02, 0.25, 0.8};  ///< linear RGB

  bool any() const { return shown; }
};

}  // namespace bihive
