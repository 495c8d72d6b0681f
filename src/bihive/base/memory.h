// The size of the memory that this program may use, and the test whether something fits into it.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// The smallest of four: this machine's memory (in a browser, the largest heap of the page); BIHIVE_MEMORY in the
/// environment, a number of bytes; the limit of the control group (a container), version 1 or 2; the limits of the
/// process: RLIMIT_AS less what it has mapped already, and RLIMIT_DATA as it is.
struct MemoryLimit {
  double bytes;
  std::string whose;  ///< "this machine has", "BIHIVE_MEMORY allows", ...: the number follows
};
MemoryLimit memory_limit();

/// memory_limit().bytes
double memory_bytes();

/// An error if `bytes` is more than memory_bytes(). Its message begins with `what`: "the tree of 12 spheres".
Status check_memory(double bytes, const std::string& what);

}  // namespace bihive
