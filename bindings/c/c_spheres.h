// The spheres that callers of bihive.h pass.
#pragma once

#include <cstdint>
#include <string>

#include "bihive/geometry/rounding_loss.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive::c {

/// The set of `count` spheres, read in place. `warning`: a sentence if centres move too far; may be null.
inline Result<SphereSet> spheres_of(const double* xyz, const double* radii, std::int64_t count,
                                    std::string* warning = nullptr) {
  const auto column = [count](const double* first, std::ptrdiff_t step) {
    return NumbersView{first, step * static_cast<std::ptrdiff_t>(sizeof(double)), static_cast<std::size_t>(count),
                       NumbersView::Precision::binary64};
  };
  const NumbersView x = column(xyz, 3), y = column(xyz + 1, 3), z = column(xyz + 2, 3), r = column(radii, 1);
  Result<SphereSet> set = SphereSet::from_world(x, y, z, r, SphereSet::Origin::fitting);
  if (set && warning != nullptr) *warning = rounding_warning(rounding_loss(*set, x, y, z, r), count);
  return set;
}

}  // namespace bihive::c
