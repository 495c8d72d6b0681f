// The maximum number of spheres of a wide tree: their numbers have 32 bits, and the largest number means none.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "bihive/base/result.h"

namespace bihive {

constexpr std::int64_t kMostSpheresOfWideTree = std::numeric_limits<std::uint32_t>::max();

/// Error: more spheres.
inline Status check_wide_count(std::int64_t spheres) {
  if (spheres <= kMostSpheresOfWideTree) return Done{};
  return Error{"a wide tree holds at most " + std::to_string(kMostSpheresOfWideTree) + " spheres, and there are " +
                   std::to_string(spheres),
               "", 0, 0, ""};
}

}  // namespace bihive
