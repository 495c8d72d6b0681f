// Stands for a missing bound, in binary32.
#pragma once

#include <limits>

namespace bihive {

constexpr float kInfiniteFloat = std::numeric_limits<float>::infinity();

}  // namespace bihive
