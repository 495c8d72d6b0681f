#include "compare.h"

#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/compare/comparison.h"
#include "bihive/compare/comparison_json.h"
#include "bihive/compare/tune.h"
#include "errors.h"
#include "spheres.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

// Queries of the spheres for `options`; what text_of(scene) returns. The names are known ones.
template <class Options, class TextOf>
std::string measured(const Spheres& spheres, const std::vector<std::string>& kinds, std::int64_t count,
                     Options& options, const TextOf& text_of) {
  Scene scene;
  scene.name = spheres.name;
  scene.spheres = spheres.file.spheres;
  workbench::complete_for_queries(scene, /*has_camera=*/false, /*has_lights=*/false);
  options.kinds = value_of(workbench::query_kinds_named(kinds));
  options.count = count;
  std::string json;
  wait_for(
      [&](Work& work) {
        // Ctrl-C ends it between two kinds of queries, or two rounds.
        options.progress = [&work](double) {
          if (work.cancel.cancelled()) throw Cancelled{};
        };
        json = text_of(scene);
      },
      py::none());
  return json;
}

// The text of docs/comparison.schema.json.
std::string compare(const Spheres& spheres, const std::vector<std::string>& structures,
                    const std::vector<std::string>& kinds, std::int64_t count, const std::vector<int>& threads) {
  workbench::ComparisonOptions options;
  options.structures = structures;
  options.threads = threads;
  return measured(spheres, kinds, count, options, [&](const Scene& scene) {
    return workbench::comparison_json(value_of(workbench::compare_structures(scene, options)), scene.name);
  });
}

// The text of docs/tuning.schema.json.
std::string tune(const Spheres& spheres, const std::string& structure, const std::vector<std::string>& kinds,
                 std::int64_t count, int threads) {
  workbench::TuneOptions options;
  options.structure = structure;
  options.threads = threads;
  return measured(spheres, kinds, count, options, [&](const Scene& scene) {
    return workbench::tuning_json(value_of(workbench::tune_structure(scene, options)), scene.name);
  });
}

}  // namespace

void bind_comparisons(py::module_& module) {
  module.def("compare", compare);
  module.def("tune", tune);
  module.def("structure_names", [] {
    std::vector<std::string> names;
    for (const workbench::StructureRow& row : workbench::structures()) names.emplace_back(row.name);
    return names;
  });
  module.def("tuned_structure_names", [] {
    std::vector<std::string> names;
    for (const workbench::StructureRow& row : workbench::structures())
      if ((row.takes & workbench::kTakesMaxPrims) != 0) names.emplace_back(row.name);
    return names;
  });
  module.def("query_kind_names", [] {
    std::vector<std::string> names;
    for (const workbench::QueryKindRow& row : workbench::kQueryKinds) names.emplace_back(row.name);
    return names;
  });
}

}  // namespace bihive::python
