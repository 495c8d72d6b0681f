// The one place where threads are made: oneTBB natively, a small pool of our own under WebAssembly and ThreadSanitizer.
#pragma once

#include <cstdint>
#include <functional>

namespace bihive {

/// The number of threads this machine runs at once, at least 1.
int hardware_threads();

/// Calls body(i) once for each 0 <= i < count, on at most `threads` threads (0 = hardware_threads()), in any order, and
/// returns when all calls have. Whatever the body writes must depend on i alone, so that the thread count cannot show.
/// The body must not throw.
void parallel_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body);

}  // namespace bihive
