// Peak memory of the program.
#pragma once

namespace bihive::cli {

/// The peak resident set size, in bytes.
double peak_memory_bytes();

}  // namespace bihive::cli
