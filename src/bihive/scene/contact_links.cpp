#include "bihive/scene/contact_links.h"

#include "bihive/measure/union_measures.h"

namespace bihive {

Result<LinkTable> contact_links(const Scene& scene, double probe, int threads) {
  MeasureOptions options;
  options.probe = probe;
  options.threads = threads;
  options.contacts = true;
  const Result<UnionMeasures> measures = measure_union(scene.spheres, options);
  if (!measures) return measures.error();
  LinkTable table;
  std::vector<double> areas;
  for (const Contact& contact : measures->contacts) {
    table.pairs.push_back({input_id(scene, contact.first), input_id(scene, contact.second)});
    table.images.push_back(contact.image);
    areas.push_back(contact.area);
  }
  table.columns.emplace_back("area", std::move(areas));
  return table;
}

}  // namespace bihive
