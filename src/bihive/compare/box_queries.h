// Boxes instead of spheres: all boxes that a ray meets, and all that contain a point, by several structures.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/compare/structure.h"
#include "bihive/geometry/ray.h"
#include "bihive/math/vec3.h"

namespace bihive::workbench {

/// A closed box in binary64; lo <= hi along each axis, and finite.
struct Box {
  Vec3d lo, hi;
};

/// Whether a point lies in a box, its surface included.
bool contains(const Box& box, Vec3d point);
/// Whether a valid ray meets a box within its segment, both surfaces included: t of the six planes, (plane - origin) /
/// direction in binary64, decide. `leaves` and `inside` do not count.
bool meets(const Box& box, const Ray& ray);

/// A structure over boxes; it keeps a copy of them. Any number of threads may ask it.
class BoxStructure {
 public:
  virtual ~BoxStructure() = default;
  virtual StructureFacts facts() const = 0;
  /// The positions of all boxes that the valid ray meets, or that contain the finite point, ascending. Adds its steps:
  /// Work::sphere_tests are of boxes in leaves.
  virtual void boxes_of_ray(const Ray& ray, std::vector<std::int64_t>& found, Work& work) const = 0;
  virtual void boxes_of_point(Vec3d point, std::vector<std::int64_t>& found, Work& work) const = 0;
};

struct BoxStructureRow {
  const char* name;
  const char* title;
  /// Error: more than 2^32 - 1 boxes, or not enough memory.
  Result<std::unique_ptr<const BoxStructure>> (*build)(const std::vector<Box>& boxes);
};
/// The reference BIH, a BVH by the surface area heuristic, and brute force, by the names that spheres know.
const std::vector<BoxStructureRow>& box_structures();

/// One kind of queries: rays from anywhere in the boxes' bounds in any direction, or points anywhere in them.
struct BoxKindResult {
  std::int64_t queries = 0;
  double ms = 0;                                    ///< of all of them once
  double nodes = 0, box_tests = 0, item_tests = 0;  ///< means per query; item tests: of boxes in leaves
  double found = 0;                                 ///< boxes per query, mean
  std::int64_t different = 0;                       ///< queries with other boxes than brute force finds
};
struct BoxStructureResult {
  BoxStructureRow row;
  double build_ms = 0;
  StructureFacts facts;
  BoxKindResult rays, points;
};

/// `count` queries of each kind, fewer where brute force would test more than 2^28 boxes; on one thread. `boxes` is not
/// empty.
Result<std::vector<BoxStructureResult>> compare_box_structures(const std::vector<Box>& boxes, std::int64_t count);

}  // namespace bihive::workbench
