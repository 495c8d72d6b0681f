// The spheres that callers of bihive.h pass.
#pragma once

#include <cstdint>

#include "bihive/geometry/sphere_set.h"

namespace bihive::c {

/// The set of `count` spheres, read in place.
inline Result<SphereSet> spheres_of(const double* xyz, const double* radii, std::int64_t count) {
  const auto column = [count](const double* first, std::ptrdiff_t step) {
    return NumbersView{first, step * static_cast<std::ptrdiff_t>(sizeof(double)), static_cast<std::size_t>(count),
                       NumbersView::Precision::binary64};
  };
  return SphereSet::from_world(column(xyz, 3), column(xyz + 1, 3), column(xyz + 2, 3), column(radii, 1));
}

}  // namespace bihive::c
