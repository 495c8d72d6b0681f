// The limit of data of a program in a control group, while threads draw or trace.
#pragma once

#include <cstdint>

#include "bihive/base/memory.h"
#include "bihive/base/parallel.h"

namespace bihive::cli {

/// Renews the limit (base/memory.h) with allowance for memory that threads reserve for their rays but do not touch. 0:
/// all threads.
inline void renew_group_limit_for_threads(std::int64_t threads) {
  constexpr double kReservedByThread = 24 << 20;
  turn_group_limit_into_failing_allocations(kReservedByThread *
                                            static_cast<double>(threads > 0 ? threads : hardware_threads()));
}

}  // namespace bihive::cli
