// What the program took of the memory.
#pragma once

namespace bihive::cli {

/// The largest resident set so far, in bytes.
double peak_memory_bytes();

}  // namespace bihive::cli
