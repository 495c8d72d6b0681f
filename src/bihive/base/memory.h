// The memory that this program may use, and a check whether an allocation fits.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// The smallest of four: this machine's memory (in a browser, the largest heap of the page); BIHIVE_MEMORY in the
/// environment, a number of bytes; what the control group (a container), version 1 or 2, leaves after all that is in
/// use in it; what the limits of the process (RLIMIT_AS, RLIMIT_DATA) leave after all that it has mapped.
struct MemoryLimit {
  double bytes;
  std::string whose;  ///< "this machine has", "BIHIVE_MEMORY allows", ...: the number follows
};
MemoryLimit memory_limit();

/// memory_limit().bytes
double memory_bytes();

/// An error if `bytes` more do not fit. Its message begins with `what`: "the tree of 12 spheres". `held_bytes`: what
/// the same work holds already; the limits that do not know what is in use, the machine's and BIHIVE_MEMORY, count it
/// too. `overhead_bytes`: what any work takes beside its data, such as buffers of threads; the other limits count it.
Status check_memory(double bytes, const std::string& what, double held_bytes = 0, double overhead_bytes = 0);

/// The error after an allocation that failed: "not enough memory for `what`", with the limit.
Error no_memory_for(const std::string& what);

/// For programs, not for libraries: where a control group limits the memory, the kernel would kill a process that takes
/// more. This lowers the process's own limit of data to what the group leaves now, so that allocations fail instead.
/// To be called again after the group's use has changed. `allowance_bytes`: address space that will be reserved but
/// hardly used, such as stacks of threads. Returns a text that says which limit it is, or null if there is none.
const char* turn_group_limit_into_failing_allocations(double allowance_bytes = 0);

}  // namespace bihive
