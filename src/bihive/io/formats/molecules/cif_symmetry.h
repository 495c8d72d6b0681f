// The operations of symmetry that a CIF states, by gemmi: listed ones, those of magnetic CIF, or those of its group.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/math/vec3.h"

namespace gemmi::cif {
struct Block;
}  // namespace gemmi::cif

namespace bihive {

/// Of shares of the cell.
struct SymmetryOperation {
  std::array<std::array<double, 3>, 3> turn{};
  std::array<double, 3> shift{};

  Vec3d of(Vec3d fraction) const;
};

struct CifSymmetry {
  std::vector<SymmetryOperation> operations;  ///< at least one; the identity comes first as a rule
  std::string rule;                           ///< what they are
  std::string warning;                        ///< symmetry is stated, but not in a form that is read; without the file
};

/// Tags have underscores in place of dots. The cell's angles alpha and gamma, in degrees, tell hexagonal from
/// rhombohedral axes. Errors name no file.
Result<CifSymmetry> symmetry_of(gemmi::cif::Block& block, double alpha, double gamma);

}  // namespace bihive
