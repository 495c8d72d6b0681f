// Double, triple and aromatic bonds as parallel sticks.
#pragma once

#include <functional>
#include <vector>

#include "bihive/geometry/sphere_attributes.h"
#include "bihive/geometry/stick_set.h"

namespace bihive {

/// Whether a bond of this order is drawn as more than one stick.
inline bool has_parallel_sticks(BondOrder order) {
  return order == BondOrder::double_bond || order == BondOrder::triple || order == BondOrder::aromatic;
}

/// Radii and distances of parallel sticks beside the radius of a single bond. The centres of neighbouring sticks are
/// `spacing` apart.
struct ParallelSticks {
  double radius, spacing;
};
constexpr ParallelSticks kDoubleBond{0.5, 1.6}, kTripleBond{0.42, 1.3}, kAromaticBond{0.5, 1.6};
constexpr double kRadiusOfDashes = 0.36;  ///< of the dashed stick of an aromatic bond

/// The sticks of those bonds whose order has parallel ones. `radius`: of a single bond (world units). `bonds` are in
/// the order of io/bonds.h, `orders` has one for each.
///
/// Two sticks of a double bond lie on either side of the axis between its atoms, three of a triple bond also on it, in
/// the plane of the axis and of the first atom that lies off it by more than 10 degrees: neighbours of the first atom
/// in the order of ids, then those of the second, then the neighbours of neighbours. Of a molecule on one line the
/// plane holds the world axis that is closest to a right angle with the bond, of equal ones x before y before z.
///
/// An aromatic bond is a stick on the axis and a dashed one inside its ring: parallel to the axis, and shortened as the
/// ring is towards its centre. The ring is the smallest of at most 8 aromatic bonds, of equal ones the first in the
/// order of ids. Without one, the dashed stick lies in the plane described above.
///
/// A bond to an image has stubs, and a bond that `is_parted` names is parted in the middle, as StickSet::between().
std::vector<OwnStick> parallel_sticks(const SphereSet& spheres, const std::vector<ImagePair>& bonds,
                                      const std::vector<BondOrder>& orders, double radius,
                                      const std::function<bool(const SpherePair&)>& is_parted = nullptr);

}  // namespace bihive
