// The memory that this process holds, and its peak.
#pragma once

#include <cstdint>

namespace bihive::bench {

/// Resident bytes now; 0 if the system does not report them.
std::int64_t resident_bytes();

/// The peak of resident bytes since forget_peak().
std::int64_t peak_bytes();
void forget_peak();

}  // namespace bihive::bench
