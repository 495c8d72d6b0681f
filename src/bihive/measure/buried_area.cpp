#include "bihive/measure/buried_area.h"

#include <algorithm>
#include <string>
#include <utility>

#include "bihive/math/vec3.h"

namespace bihive {
namespace {

// Whose spheres, grown by the probe, lie in it. World units.
struct Box {
  Vec3d lo, hi;
  bool empty = true;

  void add(Vec3d centre, double radius) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = empty ? centre[axis] - radius : std::min(lo[axis], centre[axis] - radius);
      hi[axis] = empty ? centre[axis] + radius : std::max(hi[axis], centre[axis] + radius);
    }
    empty = false;
  }
  bool meets(const Box& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (lo[axis] > other.hi[axis] || other.lo[axis] > hi[axis]) return false;
    return !empty && !other.empty;
  }
};

}  // namespace

Result<BuriedAreas> buried_areas(const SphereSet& set, const std::vector<std::int32_t>& group_of_sphere,
                                 const MeasureOptions& options) {
  const auto spheres = static_cast<std::size_t>(set.size());
  if (group_of_sphere.size() != spheres)
    return Error{"there are " + std::to_string(group_of_sphere.size()) + " groups of spheres for " +
                     std::to_string(spheres) + " spheres",
                 "", 0, 0, ""};
  const auto counts = [&](std::size_t i) {
    return group_of_sphere[i] >= 0 && (options.mask == nullptr || options.mask[i] != 0);
  };
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < spheres; ++i) {
    if (group_of_sphere[i] < 0) continue;
    const auto group = static_cast<std::size_t>(group_of_sphere[i]);
    if (group >= boxes.size()) boxes.resize(group + 1);
    const auto id = static_cast<std::int64_t>(i);
    if (counts(i)) boxes[group].add(set.local_centre(id), set.radius(id) + options.probe);
  }
  const std::size_t count = boxes.size();

  MeasureOptions of_groups = options;
  of_groups.cavities = of_groups.sphere_volumes = of_groups.contacts = of_groups.derivatives = false;
  std::vector<std::uint8_t> mask(spheres);
  of_groups.mask = mask.data();
  const auto measured = [&](std::size_t g, std::size_t h) {
    for (std::size_t i = 0; i < spheres; ++i) {
      const auto group = static_cast<std::size_t>(group_of_sphere[i]);
      mask[i] = counts(i) && (group == g || group == h) ? 1 : 0;
    }
    return measure_union(set, of_groups);
  };

  BuriedAreas areas;
  areas.buried.assign(count * count, 0.0);
  std::vector<double> alone(spheres, 0.0);
  double most = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const Result<UnionMeasures> measures = measured(g, g);
    if (!measures) return measures.error();
    areas.alone.push_back(measures->area);
    most = std::max(most, measures->area_error);
    for (std::size_t i = 0; i < spheres; ++i) alone[i] += measures->sphere_area[i];
  }
  areas.error = 2 * most;
  most = 0;
  for (std::size_t g = 0; g < count; ++g)
    for (std::size_t h = g + 1; h < count; ++h) {
      if (!options.periodic && !boxes[g].meets(boxes[h])) continue;
      const Result<UnionMeasures> measures = measured(g, h);
      if (!measures) return measures.error();
      // Sphere by sphere: where nothing changes, nothing is lost.
      double buried = 0;
      for (std::size_t i = 0; i < spheres; ++i)
        if (mask[i] != 0) buried += alone[i] - measures->sphere_area[i];
      areas.buried[g * count + h] = areas.buried[h * count + g] = buried;
      most = std::max(most, measures->area_error);
    }
  areas.error += most;
  return areas;
}

}  // namespace bihive
