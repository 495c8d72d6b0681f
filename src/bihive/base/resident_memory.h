// The memory that this process holds, and its peak, as Linux reports them.
#pragma once

#include <cstdint>

namespace bihive {

/// Resident bytes now; 0 if the system does not report them.
std::int64_t resident_bytes();

/// The peak of resident bytes since forget_peak(); 0 if the system does not report it.
std::int64_t peak_bytes();

/// False where the system does not let a process do so; peak_bytes() is that since its start then.
bool forget_peak();

}  // namespace bihive
