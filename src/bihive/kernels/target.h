// Which instruction set the kernels run on.
#pragma once

#include <string>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// The names of those that this machine can run, best first: avx512, avx2, sse4, neon, wasm, scalar.
std::vector<std::string> available_targets();

/// The one in use: the best, or the one that the environment variable BIHIVE_TARGET names.
std::string active_target();

/// Uses another one from now on, for comparisons and tests. Not while a query or a build runs. "" goes back to the
/// best. Error: not among available_targets().
Status use_target(const std::string& name);

/// An error if BIHIVE_TARGET names a target that this machine cannot run; the library then uses the best one.
Status check_target_environment();

}  // namespace bihive
