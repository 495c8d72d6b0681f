#include "bihive/scene/framed_spheres.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/geometry/lattice.h"
#include "bihive/scene/central_box.h"

namespace bihive {
namespace {

// The spheres that are seen, and the balls at the ends of sticks that have ends of their own. Others do not reach
// beyond the spheres that they join.
SphereSet with_ends(const SphereSet& spheres, const Scene& scene) {
  std::vector<std::int64_t> ids;
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    if (spheres.stored_radius(id) > 0) ids.push_back(id);
  SphereSet made = spheres.part(ids);
  const Images images = made.images();
  // One copy has other units, in which the ends need room again.
  const bool has_images = made.has_images() && made.replicate(images.vectors, {1, 1, 1});
  const StickSet& sticks = scene.sticks;
  const double in_world = scene.spheres.inverse_scale();
  std::vector<std::pair<Vec3d, double>> balls;
  double extent = 0;
  for (std::int64_t k = sticks.size() - sticks.own_count(); k < sticks.size(); ++k) {
    const Stick stick = sticks.stored(scene.spheres, k);
    for (const auto& [end, radius] : {std::pair(stick.a, stick.radius_a), std::pair(stick.b, stick.radius_b)}) {
      balls.emplace_back(in_world * end, in_world * radius);
      extent = std::max(extent, largest_coordinate(balls.back().first) + balls.back().second);
    }
  }
  made.make_room(extent);
  StoredSpheres stored;
  for (const auto& [centre, radius] : balls) {
    const Vec3f at = to_float(made.scale() * centre);
    stored.x.push_back(at.x);
    stored.y.push_back(at.y);
    stored.z.push_back(at.z);
    stored.r.push_back(static_cast<float>(made.scale() * radius));
  }
  made.append_stored(stored);
  return has_images && !made.replicate(images.vectors, images.counts) ? spheres : made;
}

}  // namespace

FramedSpheres::FramedSpheres(const Scene& scene, double share) : remaining_(scene) {
  const SphereSet& all = remaining_.set();
  if (all.empty()) return;
  if (share >= 1) {
    if (scene.sticks.own_count() > 0) part_ = with_ends(all, scene);
    return;
  }
  const CentralBox box = central_box(all, share);
  std::vector<std::int64_t> inside;
  for (std::int64_t id = 0; id < all.size(); ++id)
    if (box.holds(all, static_cast<std::size_t>(id))) inside.push_back(id);
  if (!inside.empty()) part_ = all.part(inside);
}

}  // namespace bihive
