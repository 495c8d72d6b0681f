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

/// What the active target's code reports about itself: Highway's name of the target that it was compiled for ("AVX3",
/// "AVX2", "SSE4", "NEON", "WASM", "EMU128", "SCALAR") and how many numbers of binary32 it works on at once. Proves
/// which code runs.
struct CompiledTarget {
  std::string name;
  int float_lanes = 0;
};
CompiledTarget compiled_target();

/// An error if BIHIVE_TARGET names a target that this machine cannot run; the library then uses the best one.
Status check_target_environment();

}  // namespace bihive
