// bvh-sah: a BVH built from the top by the surface area heuristic, with centres in bins [Wald2007].

#include "bihive/compare/sah_builder.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

struct SphereItems {
  const SphereSet& spheres;

  std::int64_t count() const { return spheres.size(); }
  Aabb box(std::uint32_t id) const { return outward_box(spheres, id); }
  Vec3d centre(std::uint32_t id) const { return spheres.stored_centre(id); }
};

}  // namespace

Result<StructurePointer> build_bvh_sah(const SphereSet& spheres, const StructureParameters& parameters, int) {
  return build_or_error(spheres, "bvh-sah", [&]() -> StructurePointer {
    return std::make_unique<BoxTreeStructure>(spheres, SahBuilder(SphereItems{spheres}, parameters).build());
  });
}

}  // namespace bihive::workbench
