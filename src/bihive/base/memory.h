// The memory that there is, and whether something would fit.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// Bytes of this machine's memory; in a browser, of the page's heap at most. Where the environment has BIHIVE_MEMORY, a
/// number of bytes, as if there were no more than that.
double memory_bytes();

/// Error: so many bytes are more than memory_bytes(); the message begins with `what`, "the tree of 12 spheres".
Status check_memory(double bytes, const std::string& what);

}  // namespace bihive
