#include "compare.h"

#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/compare/comparison.h"
#include "bihive/compare/comparison_json.h"
#include "errors.h"
#include "spheres.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

// The text of docs/comparison.schema.json. The names are known ones.
std::string compare(const Spheres& spheres, const std::vector<std::string>& structures,
                    const std::vector<std::string>& kinds, std::int64_t count, const std::vector<int>& threads) {
  Scene scene;
  scene.name = spheres.name;
  scene.spheres = spheres.file.spheres;
  workbench::complete_for_queries(scene, /*has_camera=*/false, /*has_lights=*/false);
  workbench::ComparisonOptions options;
  options.structures = structures;
  for (const std::string& kind : kinds) options.kinds.push_back(value_of(workbench::query_kind_named(kind)));
  options.count = count;
  options.threads = threads;
  std::string json;
  wait_for(
      [&](Work& work) {
        // Ctrl-C ends it between two kinds of queries.
        options.progress = [&work](double) {
          if (work.cancel.cancelled()) throw Cancelled{};
        };
        json = workbench::comparison_json(value_of(workbench::compare_structures(scene, options)), scene.name);
      },
      py::none());
  return json;
}

}  // namespace

void bind_comparisons(py::module_& module) {
  module.def("compare", compare);
  module.def("structure_names", [] {
    std::vector<std::string> names;
    for (const workbench::StructureRow& row : workbench::structures()) names.emplace_back(row.name);
    return names;
  });
  module.def("query_kind_names", [] {
    std::vector<std::string> names;
    for (const workbench::QueryKindRow& row : workbench::kQueryKinds) names.emplace_back(row.name);
    return names;
  });
}

}  // namespace bihive::python
