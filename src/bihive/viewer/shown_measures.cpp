#include "bihive/viewer/shown_measures.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "bihive/measure/union_measures.h"
#include "bihive/select/selection.h"

namespace bihive {

Result<std::string> shown_measures_to_json(const Scene& scene, const SphereSet& input, std::string_view selection,
                                           double probe) {
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(input.size()), 1);
  if (!selection.empty()) {
    Result<std::vector<std::uint8_t>> selected = select_spheres(input, selection);
    if (!selected) return selected.error();
    mask = std::move(*selected);
  }
  if (!scene.id_in_input.empty()) {
    std::vector<std::uint8_t> shown(mask.size(), 0);
    for (const std::int64_t id : scene.id_in_input) shown[static_cast<std::size_t>(id)] = 1;
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] &= shown[i];
  }
  const auto count = std::count(mask.begin(), mask.end(), std::uint8_t{1});
  if (count == 0) return Error{"none of the shown spheres is selected, so there is nothing to measure", "", 0, 0, ""};
  MeasureOptions options;
  options.probe = probe;
  options.mask = mask.data();
  options.cavities = true;
  const Result<UnionMeasures> measures = measure_union(input, options);
  if (!measures) return measures.error();
  nlohmann::ordered_json volumes = nlohmann::ordered_json::array();
  for (const Cavity& cavity : measures->cavities) volumes.push_back(cavity.volume);
  return nlohmann::ordered_json{{"spheres", count},
                                {"area", measures->area},
                                {"area_error", measures->area_error},
                                {"volume", measures->volume},
                                {"volume_error", measures->volume_error},
                                {"components", measures->components},
                                {"undecided_spheres", measures->undecided_spheres},
                                {"cavities", std::move(volumes)}}
      .dump();
}

}  // namespace bihive
