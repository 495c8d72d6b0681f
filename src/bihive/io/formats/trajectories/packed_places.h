// Places as XTC files pack them: whole numbers of a chosen precision, in as few bits as neighbours allow.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// The numbers before the packed bits of a frame.
struct PackedHead {
  std::int64_t count;      ///< places, more than kUnpacked
  float precision;         ///< whole numbers are places times this
  std::int32_t lowest[3];  ///< of the whole numbers along each axis
  std::int32_t highest[3];
  std::int32_t small_size;  ///< position in the table of sizes for places near the one before
};

/// So few places are not packed.
constexpr std::int64_t kUnpacked = 9;

/// The places x0 y0 z0 x1 ... in the file's unit, in binary32 as GROMACS reads them, or an empty result if the bits
/// make no such places.
std::vector<float> unpack_places(const PackedHead& head, std::string_view bits);

}  // namespace bihive
