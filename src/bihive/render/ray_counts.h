// The number of rays that a picture took, by purpose.
#pragma once

#include <cstdint>

namespace bihive {

struct RenderCounts {
  std::int64_t primary = 0, shadow = 0, reflected = 0, transmitted = 0, ambient = 0;  ///< rays traced

  RenderCounts& operator+=(const RenderCounts& more) {
    primary += more.primary;
    shadow += more.shadow;
    reflected += more.reflected;
    transmitted += more.transmitted;
    ambient += more.ambient;
    return *this;
  }
};

}  // namespace bihive
