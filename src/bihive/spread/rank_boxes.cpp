#include "bihive/spread/rank_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/math/interval.h"

namespace bihive {
namespace {

// A ray prepared for boxes.
struct BoxRay {
  Vec3d origin, inverse;
  double t_min, t_max;
  double pad;  // as for Slabs (bih/traversal.h), which covers all rounding here

  BoxRay(const Ray& ray, double scale) {
    const ScaledRay scaled(ray, scale);
    origin = scaled.origin;
    for (int axis = 0; axis < 3; ++axis) inverse[axis] = 1 / scaled.direction[axis];
    t_min = scaled.t_min;
    t_max = scaled.t_max;
    const double farthest = std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)}) + 2.0;
    pad = 0x1p-24 + 0x1p-46 * farthest;
  }

  Interval inside(const RankBox& box) const {
    Interval part{t_min, t_max};
    if (box.empty()) return {1, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = box.lo[axis] - pad - origin[axis];
      const double hi = box.hi[axis] + pad - origin[axis];
      if (std::isinf(inverse[axis])) {
        if (lo > 0 || hi < 0) return {1, 0};
        continue;
      }
      const double t_lo = lo * inverse[axis], t_hi = hi * inverse[axis];
      part.t_near = std::max(part.t_near, std::min(t_lo, t_hi));
      part.t_far = std::min(part.t_far, std::max(t_lo, t_hi));
    }
    return part;
  }
};

}  // namespace

void RankBox::add(const RankBox& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = std::min(lo[axis], other.lo[axis]);
    hi[axis] = std::max(hi[axis], other.hi[axis]);
  }
}

RankBox box_of(const SphereSet& spheres) {
  RankBox box;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const double radius = spheres.stored_radius(id);
    if (!(radius > 0)) continue;
    const Vec3d centre = spheres.stored_centre(id);
    box.add({centre - Vec3d{radius, radius, radius}, centre + Vec3d{radius, radius, radius}});
  }
  return box;
}

RankBoxes::RankBoxes(std::vector<RankBox> boxes, double scale) : boxes_(std::move(boxes)), scale_(scale) {
  if (!boxes_.empty()) make(0, static_cast<std::int32_t>(boxes_.size()) - 1);
}

std::int32_t RankBoxes::make(std::int32_t first, std::int32_t last) {
  const auto number = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({{}, first, last, -1, -1});
  RankBox box = boxes_[static_cast<std::size_t>(first)];
  if (first < last) {
    const std::int32_t middle = first + (last - first) / 2;
    const std::int32_t lower = make(first, middle);
    const std::int32_t higher = make(middle + 1, last);
    nodes_[static_cast<std::size_t>(number)].lower = lower;
    nodes_[static_cast<std::size_t>(number)].higher = higher;
    box = nodes_[static_cast<std::size_t>(lower)].box;
    box.add(nodes_[static_cast<std::size_t>(higher)].box);
  }
  nodes_[static_cast<std::size_t>(number)].box = box;
  return number;
}

void RankBoxes::find(const Ray& ray, std::vector<RankOnWay>& found) const {
  if (nodes_.empty()) return;
  const BoxRay box_ray(ray, scale_);
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  std::int32_t waiting[64] = {0};  // each level of the tree leaves one waiting
  int count = 1;
  while (count > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(waiting[--count])];
    const Interval part = box_ray.inside(node.box);
    if (part.empty()) continue;
    if (node.lower < 0) {
      found.push_back({part.t_near, node.first});
      continue;
    }
    waiting[count++] = node.higher;
    waiting[count++] = node.lower;
  }
  std::sort(found.begin() + before, found.end(),
            [](const RankOnWay& a, const RankOnWay& b) { return a.t != b.t ? a.t < b.t : a.rank < b.rank; });
}

}  // namespace bihive
