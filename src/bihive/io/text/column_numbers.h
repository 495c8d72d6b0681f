// The numbers that a column of a table may hold, by its role.
#pragma once

#include <cmath>

#include "bihive/io/raw_spheres.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {

/// The reason why a number cannot stand in a column of that role, or nullptr if it can.
inline const char* number_fault(ColumnRole role, double value) {
  switch (role) {
    case ColumnRole::x:
    case ColumnRole::y:
    case ColumnRole::z:
      return coordinate_fault(value);
    case ColumnRole::radius:
    case ColumnRole::diameter:
      return radius_fault(value);
    case ColumnRole::atomic_number:
      return value >= 0 && value <= 118 && value == std::floor(value) ? nullptr : "is not one of 0 to 118";
    case ColumnRole::red:
    case ColumnRole::green:
    case ColumnRole::blue:
      return value >= 0 && value <= 255 ? nullptr : "is outside 0 to 255";
    case ColumnRole::opacity:
    case ColumnRole::transparency:
      return value >= 0 && value <= 1 ? nullptr : "is outside 0 to 1";
    default:
      return nullptr;
  }
}

inline bool holds_labels(ColumnRole role) {
  return role == ColumnRole::species || role == ColumnRole::type;
}

}  // namespace bihive
