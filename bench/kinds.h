// The kinds of rays that are measured, and their names in reports.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bihive/wide/queries.h"

namespace bihive::bench {

/// primary: 8 x 8 pixel blocks of a camera. random: any origin, any direction. shadow: from the hits of the primary
/// rays to the light. mirrorK: mirrored K times. mirror_shadowK: from the hits of mirrorK to the light. ao: ambient
/// occlusion from the hits of the primary rays, along directions shared by all, as in the renderer. ao_random: the same
/// with its own directions for each hit, by cosine, as in a path tracer. comb: parallel rays towards -z through the box
/// of random rays, row by row.
enum class Kind {
  primary,
  random,
  shadow,
  mirror1,
  mirror2,
  mirror3,
  mirror_shadow2,
  mirror_shadow3,
  ao,
  ao_random,
  comb
};

struct KindFacts {
  Kind kind;
  std::string_view name;
  bool any_hit;  ///< whether anything is hit; the sphere does not matter
  RayOrder order;
  std::int64_t tile;  ///< rays that a thread takes at a time, at most, unless the user says another number
};

/// A thread passes all its random rays in one call, because the engine sorts them, and does better with more.
constexpr std::int64_t kTile = 131072, kRandomTile = 1048576;

constexpr std::array<KindFacts, 11> kKinds{{{Kind::primary, "primary", false, RayOrder::blocks, kTile},
                                            {Kind::random, "random", false, RayOrder::any, kRandomTile},
                                            {Kind::shadow, "shadow", true, RayOrder::blocks, kTile},
                                            {Kind::mirror1, "mirror1", false, RayOrder::any, kTile},
                                            {Kind::mirror2, "mirror2", false, RayOrder::any, kTile},
                                            {Kind::mirror3, "mirror3", false, RayOrder::any, kTile},
                                            {Kind::mirror_shadow2, "mirror_shadow2", true, RayOrder::any, kTile},
                                            {Kind::mirror_shadow3, "mirror_shadow3", true, RayOrder::any, kTile},
                                            {Kind::ao, "ao", true, RayOrder::blocks, kTile},
                                            {Kind::ao_random, "ao_random", true, RayOrder::any, kTile},
                                            {Kind::comb, "comb", false, RayOrder::any, kTile}}};

constexpr const KindFacts& facts_of(Kind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

}  // namespace bihive::bench
