#include "bihive/scene/framed_spheres.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bihive/scene/central_box.h"

namespace bihive {

FramedSpheres::FramedSpheres(const Scene& scene, double share) : remaining_(scene) {
  const SphereSet& all = remaining_.set();
  if (share >= 1 || all.empty()) return;
  const CentralBox box = central_box(all, share);
  std::vector<std::int64_t> inside;
  for (std::int64_t id = 0; id < all.size(); ++id)
    if (box.holds(all, static_cast<std::size_t>(id))) inside.push_back(id);
  if (!inside.empty()) part_ = all.part(inside);
}

}  // namespace bihive
