// How much memory this process holds, and held at most.
#pragma once

#include <cstdint>

namespace bihive::bench {

/// Resident bytes now; 0 where the system does not say.
std::int64_t resident_bytes();

/// Resident bytes at most since forget_peak().
std::int64_t peak_bytes();
void forget_peak();

}  // namespace bihive::bench
