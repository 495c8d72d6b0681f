// The list of structures.
#include "bihive/compare/structure.h"

namespace bihive::workbench {

// Each in its own source file.
Result<StructurePointer> build_wide(const SphereSet& spheres, int threads);
Result<StructurePointer> build_bih(const SphereSet& spheres, int threads);
Result<StructurePointer> build_bvh_sah(const SphereSet& spheres, int threads);
Result<StructurePointer> build_bvh_lbvh(const SphereSet& spheres, int threads);
Result<StructurePointer> build_grid(const SphereSet& spheres, int threads);
Result<StructurePointer> build_pkd(const SphereSet& spheres, int threads);
Result<StructurePointer> build_brute(const SphereSet& spheres, int threads);

const std::vector<StructureRow>& structures() {
  static const std::vector<StructureRow> rows{
      {"wide", "wide BIH, vectors", build_wide},
      {"bih", "reference BIH of the thesis", build_bih},
      {"bvh-sah", "BVH by the surface area heuristic", build_bvh_sah},
      {"bvh-lbvh", "BVH along the Z-curve", build_bvh_lbvh},
      {"grid", "uniform grid", build_grid},
      {"pkd", "balanced k-d tree of the spheres", build_pkd},
      {"brute", "every sphere, one after the other", build_brute},
  };
  return rows;
}

Result<StructureRow> structure_named(const std::string& name) {
  std::string all;
  for (const StructureRow& row : structures()) {
    if (name == row.name) return row;
    all += (all.empty() ? "" : ", ") + std::string(row.name);
  }
  return Error{"there is no structure \"" + name + "\"; there are " + all, "", 0, 0, ""};
}

}  // namespace bihive::workbench
