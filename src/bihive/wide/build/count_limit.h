// How many spheres a wide tree holds: their numbers take 32 bits there, and the largest number marks none.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "bihive/base/result.h"

namespace bihive {

constexpr std::int64_t kMostSpheresOfWideTree = std::numeric_limits<std::uint32_t>::max();

/// An error for more.
inline Status check_wide_count(std::int64_t spheres) {
  if (spheres <= kMostSpheresOfWideTree) return Done{};
  return Error{"a wide tree holds at most " + std::to_string(kMostSpheresOfWideTree) + " spheres, and there are " +
                   std::to_string(spheres),
               "", 0, 0, ""};
}

}  // namespace bihive
