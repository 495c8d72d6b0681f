// Rays against the wide tree: one at a time, or many at once.
//
// All forms give the bits of the scalar reference (bih/traversal.h) on every instruction set. They may be called from
// any number of threads at a time on one tree; each call works on its own thread, in memory that the thread keeps (up
// to some 45 MiB, and 60 bytes for each of up to 1048576 scattered rays). An invalid ray (geometry/ray.h) hits nothing.
// Hold the std::shared_ptr that the builder gave for as long as a call runs.
//
// The form for many rays takes less time per ray (docs/library.md has figures). Pass all rays at once; fewer than some
// thousand leave the vectors idle, and more than 32768 are split into tiles of this size. Scattered rays, whose
// neighbours are far apart, are sorted first where that pays, up to 1048576 at a time: the more in one call the better
// (docs/library.md).
//
// Lengths are not checked. The caller guarantees that each array of a span holds `count` entries, or is null where
// RaySpan allows it, and that the answers have room for `count`; count 0 is fine. Throws only std::bad_alloc, when the
// thread gets no working memory.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

class PeriodicImages;

/// How coherent neighbouring rays are, as far as the caller knows. It changes the speed, never an answer. blocks: each
/// 64 neighbours, counted from the first, are close in origin and direction, as 8 x 8 pixels of a camera or their
/// shadow rays are. any: nothing is known; mirrored, transmitted, random rays.
enum class RayOrder { blocks, any };

/// The closest hit of each ray: t and id of ray i to hits.t[i] and hits.sphere_id[i]. Costs, AVX2, one thread:
/// primary rays 10 ns (4,096 spheres) to 60 ns (a million) per ray, mirrored ones 100 to 480 ns, random ones 80 to 420
/// ns (a million in one call): docs/performance.md.
void closest_hits(const WideTree& tree, const RaySpan& rays, RayOrder order, const HitSpan& hits);

/// Any hit: sets hidden[i] to 1 if ray i hits anything, else to 0. Rays that lead to one point at t = 1, as shadow rays
/// to a light do, are recognised in either order and sorted by their origins, up to 262144 at a time: with thousands of
/// them, that is up to twice as fast as other rays. Costs, AVX2, one thread: shadow rays of primary hits 20 to 250 ns
/// per ray, of mirrored hits 40 to 300 ns.
void occluded(const WideTree& tree, const RaySpan& rays, RayOrder order, std::uint8_t* hidden);

/// Every hit of each ray, with the t of geometry/sphere.h: by ray, then by t, then by id. Overwrites `hits`. The order
/// of the rays is recognised.
void all_hits(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits);

/// How the queries below share their rays.
struct RayOptions {
  RayOrder order = RayOrder::any;
  int threads = 0;                         ///< 0: all that the machine has, for 4096 rays or more each
  const PeriodicImages* images = nullptr;  ///< of the tree's set: rays meet them too. Null: the spheres alone
  /// With images: for each ray a sphere that does not count, as of PeriodicImages. Null: all count.
  const std::int64_t* exclude = nullptr;
};

/// The same queries for any number of rays: these make the threads themselves, and may be watched and cancelled
/// (base/watch.h). A cancelled call ends after some hundredths of a second, and its answers are then undefined. Error:
/// also not enough memory, and with images a ray without an end.
Status closest_hits(const WideTree& tree, const RaySpan& rays, const HitSpan& hits, const RayOptions& options = {});
Status occluded(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden, const RayOptions& options = {});
Status all_hits(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits, const RayOptions& options);

/// A single ray, for code that has only one at a time. Costs, AVX2: 0.3 us (random rays, 4,096 spheres) to 1 us (a
/// million).
Hit closest_hit(const WideTree& tree, const Ray& ray);
bool occluded(const WideTree& tree, const Ray& ray);

}  // namespace bihive
