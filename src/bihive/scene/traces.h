// Tubes through the beads of chains: sticks with ends of their own (geometry/stick_set.h).
#pragma once

#include <cstdint>

#include "bihive/base/result.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/traces.h"

namespace bihive {

struct AddedTraces {
  std::int64_t tubes = 0;
  std::int64_t beads = 0;  ///< in them
  std::int64_t alone = 0;  ///< beads without a neighbour near enough
};

/// A chain has a gap where two beads in a row are farther apart than this many median distances of such beads, or where
/// the numbers of residues jump.
constexpr double kTraceGap = 2;

/// A curve and the chords that replace it are at most this share of the tube's radius apart.
constexpr double kTraceChordShare = 1.0 / 200;

/// Adds to Scene::sticks a tube for each run of at least two beads: a centripetal Catmull-Rom curve through their
/// centres, of round cones, whose radius changes evenly from bead to bead. Its first half from a bead to the next has
/// the appearance of the first, the other half that of the second. With TraceAtoms::hidden, spheres of the beads'
/// residues get the radius 0, or the beads alone where residues are not known. Errors: the set lacks the attribute, a
/// selection's, a radius that is not above 0; as StickSet::add() and check_sticks().
Result<AddedTraces> add_traces(Scene& scene, const Traces& traces);

}  // namespace bihive
