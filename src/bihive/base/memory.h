// The size of this machine's memory, and the test whether something fits into it.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// Bytes of this machine's memory; in a browser, the largest heap of the page. BIHIVE_MEMORY in the environment, a
/// number of bytes, replaces it.
double memory_bytes();

/// An error if `bytes` is more than memory_bytes(). Its message begins with `what`: "the tree of 12 spheres".
Status check_memory(double bytes, const std::string& what);

}  // namespace bihive
