// The list of structures.
#include "bihive/base/near_name.h"
#include "bihive/compare/structure.h"

namespace bihive::workbench {

// Each in its own source file.
Result<StructurePointer> build_wide(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_bih(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_bvh_sah(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_bvh_lbvh(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_bvh_ploc(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_kd_sah(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_octree(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_grid(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_pkd(const SphereSet& spheres, const StructureParameters& parameters, int threads);
Result<StructurePointer> build_brute(const SphereSet& spheres, const StructureParameters& parameters, int threads);

const std::vector<StructureRow>& structures() {
  static const std::vector<StructureRow> rows{
      {"wide", "wide BIH, vectors", kTakesMaxPrims | kTakesMaxDepth, build_wide},
      {"bih", "reference BIH of the thesis", kTakesMaxPrims | kTakesMaxDepth, build_bih},
      {"bvh-sah", "BVH by the surface area heuristic", kTakesMaxPrims | kTakesMaxDepth | kTakesCandidates,
       build_bvh_sah},
      {"bvh-lbvh", "BVH along the Z-curve", kTakesMaxPrims, build_bvh_lbvh},
      {"bvh-ploc", "BVH merged from neighbours on the Z-curve", kTakesMaxPrims | kTakesCandidates, build_bvh_ploc},
      {"kd-sah", "k-d tree by the surface area heuristic", kTakesMaxPrims | kTakesMaxDepth | kTakesCandidates,
       build_kd_sah},
      {"octree", "octree of clipped boxes", kTakesMaxPrims | kTakesMaxDepth, build_octree},
      {"grid", "uniform grid", 0, build_grid},
      {"pkd", "balanced k-d tree of the spheres", 0, build_pkd},
      {"brute", "every sphere, one after the other", 0, build_brute},
  };
  return rows;
}

Result<StructureRow> structure_named(const std::string& name) {
  std::string all;
  std::vector<std::string> names;
  for (const StructureRow& row : structures()) {
    if (name == row.name) return row;
    names.emplace_back(row.name);
    all += (all.empty() ? "" : ", ") + std::string(row.name);
  }
  // A peer in binary32 whose answers are not those of brute force: the benchmark measures it.
  if (name == "embree")
    return Error{"Embree is not at hand: it calculates in binary32, and bihive does not contain it", "", 0, 0,
                 "bihive-bench times it and counts its different answers; that program is built where Debian's package "
                 "libembree-dev is installed"};
  const std::string near = near_name(name, names);
  return Error{"there is no structure \"" + name + "\"; there are " + all, "", 0, 0,
               near.empty() ? "" : "did you mean " + near + "?"};
}

}  // namespace bihive::workbench
