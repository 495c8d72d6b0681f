#include "bihive/compare/ray_path.h"

namespace bihive::workbench {

Result<std::vector<StructurePath>> paths_of_ray(const SphereSet& spheres, const std::vector<std::string>& names,
                                                const Ray& ray, int threads) {
  std::vector<StructureRow> rows;
  for (const std::string& name : names) {
    const Result<StructureRow> row = structure_named(name);
    if (!row) return row.error();
    rows.push_back(*row);
  }
  if (rows.empty()) rows = structures();

  std::vector<StructurePath> paths;
  for (const StructureRow& row : rows) {
    const Result<StructurePointer> structure = row.build(spheres, {}, threads);
    if (!structure) return structure.error();
    paths.push_back(
        {row.name, (*structure)->path_of_ray(ray, /*any_hit=*/false), (*structure)->work_of_ray(ray, false)});
  }
  return paths;
}

}  // namespace bihive::workbench
