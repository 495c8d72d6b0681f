// How far rounding to binary32 moves the centres of a set, and which radii it loses.
#pragma once

#include <cstdint>
#include <string>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Counts of the centres that rounding moves by more than SphereSet::kHarmlessShift of their radius, and of the radii
/// so small that the spheres become points.
struct RoundingLoss {
  std::int64_t moved = 0;
  double worst_share = SphereSet::kHarmlessShift;  ///< of the radius
  std::int64_t worst_id = -1;
  std::int64_t vanishing = 0;
};

/// Of a set that was made from these numbers and has no images. `first_id` is the id of its first sphere in the whole
/// set.
RoundingLoss rounding_loss(const SphereSet& set, const NumbersView& x, const NumbersView& y, const NumbersView& z,
                           const NumbersView& r, std::int64_t first_id = 0);

/// A sentence for the user, about a set of `all` spheres. Empty: nothing has moved.
std::string rounding_warning(const RoundingLoss& loss, std::int64_t all);

/// Whether a decimal that merely rounds to the same binary32 would not do for a centre: the set has an origin, or a
/// reader might choose one, since half a unit in the last place is more than a small share of a radius.
bool needs_all_digits(const SphereSet& spheres);

}  // namespace bihive
