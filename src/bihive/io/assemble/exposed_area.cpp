#include "bihive/io/assemble/exposed_area.h"

#include <string>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/measure/union_measures.h"

namespace bihive {

Status add_exposed_area(const SphereSet& spheres, const ReadOptions& options, SphereAttributes& attributes) {
  if (!options.exposed_area) return Done{};
  const std::string name = "exposed_area";
  if (attributes.find_numbers(name) != nullptr || attributes.find_texts(name) != nullptr)
    return Error{"there is a column " + name + " already", "", 0, 0, "leave out " + setting_name(name)};
  MeasureOptions measure;
  measure.probe = *options.exposed_area;
  measure.periodic = options.exposed_area_periodic;
  Result<UnionMeasures> measures = measure_union(spheres, measure);
  if (!measures) return measures.error();
  attributes.numbers.push_back({name, std::move(measures->sphere_area)});
  return Done{};
}

}  // namespace bihive
