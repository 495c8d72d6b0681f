// The kinds of rays that are measured, and their names in reports.
#pragma once

#include <array>
#include <string_view>

#include "bihive/kernels/queries.h"

namespace bihive::bench {

/// primary: 8 x 8 pixel blocks of a camera. random: any origin, any direction. shadow: from what the primary rays hit
/// to the light. mirrorK: mirrored K times. mirror_shadowK: from what mirrorK hits to the light.
enum class Kind { primary, random, shadow, mirror1, mirror2, mirror3, mirror_shadow2, mirror_shadow3 };

struct KindFacts {
  Kind kind;
  std::string_view name;
  bool any_hit;  ///< whether anything is hit, not what
  RayOrder order;
};

constexpr std::array<KindFacts, 8> kKinds{{{Kind::primary, "primary", false, RayOrder::blocks},
                                           {Kind::random, "random", false, RayOrder::any},
                                           {Kind::shadow, "shadow", true, RayOrder::blocks},
                                           {Kind::mirror1, "mirror1", false, RayOrder::any},
                                           {Kind::mirror2, "mirror2", false, RayOrder::any},
                                           {Kind::mirror3, "mirror3", false, RayOrder::any},
                                           {Kind::mirror_shadow2, "mirror_shadow2", true, RayOrder::any},
                                           {Kind::mirror_shadow3, "mirror_shadow3", true, RayOrder::any}}};

constexpr const KindFacts& facts_of(Kind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

}  // namespace bihive::bench
