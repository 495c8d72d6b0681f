// A structure over a set of spheres: it answers rays and points with the bits of brute force, and counts its steps.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/ray_batch.h"

namespace bihive::workbench {

/// Steps of one query.
struct Work {
  std::int64_t nodes = 0;         ///< nodes entered, leaves included; of a grid: cells
  std::int64_t leaves = 0;        ///< leaves entered; of a grid: cells with spheres
  std::int64_t box_tests = 0;     ///< boxes compared with the ray or point; planes alone do not count
  std::int64_t sphere_tests = 0;  ///< a sphere in several leaves may be tested several times
  std::int64_t test_steps = 0;    ///< sphere tests, but spheres that a structure tests together count once

  /// The surface area heuristic with one unit for a node and one for the test of a sphere, or of several together.
  double cost() const { return static_cast<double>(nodes + test_steps); }
};

/// One node on a ray's way.
struct PathStep {
  bool is_leaf = false;
  std::int64_t box_tests = 0;            ///< before it was entered
  std::vector<std::int64_t> sphere_ids;  ///< tested in it
  Hit best;                              ///< after it
};
/// The nodes of a ray in the order of its steps. The first step of a structure without nodes has all its spheres.
using RayPath = std::vector<PathStep>;

/// The nodes of a tree on one level. A line is a random one through the structure's box, which it meets with a
/// probability proportional to their surfaces.
struct LevelFacts {
  std::int64_t nodes = 0;  ///< leaves included
  std::int64_t leaves = 0;
  std::int64_t references = 0;                      ///< spheres that the nodes list
  double expected_nodes = 0, expected_spheres = 0;  ///< of the level, along a line; NaN where the box has no surface
  /// Of its inner nodes, NaN where there is none: how many children a line enters that enters the node (below 1 there
  /// are gaps between them), and the surface that children share, pair by pair, per surface of their node (above 0 they
  /// overlap).
  double children = std::numeric_limits<double>::quiet_NaN(), overlap = std::numeric_limits<double>::quiet_NaN();
};

/// Properties of a built structure, independent of queries.
struct StructureFacts {
  std::int64_t bytes = 0;       ///< of the structure alone; the set has 16 more per sphere
  std::int64_t nodes = 0;       ///< leaves included
  std::int64_t leaves = 0;      ///< of a grid: cells with spheres
  std::int64_t references = 0;  ///< spheres of all leaves, each as often as it is listed
  std::int64_t depth = 0;       ///< levels, the root's included; 0 without spheres
  /// Nodes entered and spheres tested along a random line through the structure's box that does not end at a hit: the
  /// probability that it meets a box inside is proportional to that box's surface. NaN where the box has no surface.
  double expected_nodes = std::numeric_limits<double>::quiet_NaN();
  double expected_spheres = std::numeric_limits<double>::quiet_NaN();
  double expected_test_steps = std::numeric_limits<double>::quiet_NaN();  ///< as Work::test_steps

  std::vector<LevelFacts> levels;  ///< from the root's on; empty without a tree

  double expected_cost() const { return expected_nodes + expected_test_steps; }
};

/// Immutable once built; any number of threads may ask it. It refers to the set, which must outlive it. An invalid ray
/// (geometry/ray.h) hits nothing.
class Structure {
 public:
  Structure() = default;
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;
  virtual ~Structure() = default;

  virtual StructureFacts facts() const = 0;

  /// Closest hit of each ray, and whether there is any (1 or 0).
  virtual void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const = 0;
  virtual void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const = 0;
  /// The sphere whose surface is nearest to each point (geometry/sphere_distance.h), as wide/point_queries.h defines
  /// it: `t` gets the distance in world units. Points are x, y, z in world units, one after the other, and finite.
  virtual void nearest_spheres(const double* points, std::int64_t count, const HitSpan& found) const = 0;

  /// Steps of one ray or point. The wide tree's are those of a ray by itself: its beams take rays together.
  virtual Work work_of_ray(const Ray& ray, bool any_hit) const = 0;
  virtual Work work_of_point(Vec3d point) const = 0;
  /// The steps that work_of_ray() counts, one by one.
  virtual RayPath path_of_ray(const Ray& ray, bool any_hit) const = 0;

  /// How many rays to pass in a call, so that calls of slow structures end soon.
  virtual std::int64_t rays_per_call() const { return 1024; }
};

using StructurePointer = std::unique_ptr<const Structure>;

/// Parameters of builders; 0: the structure's own choice.
struct StructureParameters {
  std::int64_t max_prims = 0;   ///< a range of at most this many spheres becomes a leaf
  std::int64_t max_depth = 0;   ///< levels, the root's and the leaves' included
  std::int64_t candidates = 0;  ///< choices compared per decision: planes along an axis, or neighbours on each side

  bool operator==(const StructureParameters&) const = default;
};

struct ParameterRow {
  const char* name;
  std::int64_t StructureParameters::*value;
  std::int64_t most;  ///< the least is 1
  const char* meaning;
};
constexpr std::array<ParameterRow, 3> kStructureParameters{
    {{"max-prims", &StructureParameters::max_prims, 1 << 20, "spheres of a leaf"},
     {"max-depth", &StructureParameters::max_depth, 1000, "levels of a tree"},
     {"candidates", &StructureParameters::candidates, 4096, "planes or neighbours compared for a decision"}}};
/// Bits of StructureRow::takes, in the order of the rows.
constexpr unsigned kTakesMaxPrims = 1, kTakesMaxDepth = 2, kTakesCandidates = 4;

/// One structure that users can name.
struct StructureRow {
  const char* name;
  const char* title;  ///< a phrase for tables
  unsigned takes;     ///< the parameters that its builder knows; it ignores the others
  /// `threads`: for builders that use them; 0: all. Errors: more spheres than it numbers, or not enough memory.
  Result<StructurePointer> (*build)(const SphereSet& spheres, const StructureParameters& parameters, int threads);
};

/// All of them, in the order of reports.
const std::vector<StructureRow>& structures();
/// The row of this name. Error: there is none; the message lists all.
Result<StructureRow> structure_named(const std::string& name);

}  // namespace bihive::workbench
