#include "commands/measure_tables.h"

#include <fmt/format.h>

#include "bihive/io/write_spheres.h"

namespace bihive::cli {

std::string table_of_spheres(const SphereSet& spheres, double probe, const UnionMeasures& measures,
                             const std::uint8_t* mask) {
  std::string csv = "id,radius,area,volume\n";
  for (std::size_t i = 0; i < measures.sphere_area.size(); ++i)
    if (mask == nullptr || mask[i] != 0)
      csv += fmt::format("{},{},{},{}\n", i, spheres.radius(static_cast<std::int64_t>(i)) + probe,
                         measures.sphere_area[i], measures.sphere_volume[i]);
  return csv;
}

std::string table_of_cavities(const std::vector<Cavity>& cavities) {
  std::string csv = "volume,area,spheres\n";
  for (const Cavity& cavity : cavities) {
    csv += fmt::format("{},{},", cavity.volume, cavity.area);
    for (std::size_t i = 0; i < cavity.spheres.size(); ++i)
      csv += fmt::format("{}{}", i > 0 ? " " : "", cavity.spheres[i]);
    csv += "\n";
  }
  return csv;
}

std::string table_of_contacts(const std::vector<Contact>& contacts, bool periodic) {
  std::string csv = periodic ? "first,second,image_a,image_b,image_c,area\n" : "first,second,area\n";
  for (const Contact& contact : contacts) {
    csv += fmt::format("{},{},", contact.first, contact.second);
    if (periodic) csv += fmt::format("{},{},{},", contact.image[0], contact.image[1], contact.image[2]);
    csv += fmt::format("{}\n", contact.area);
  }
  return csv;
}

std::string table_of_buried(const std::vector<std::string>& groups, const BuriedAreas& areas) {
  std::string csv = "group";
  for (const std::string& name : groups) csv += "," + csv_field(name);
  csv += "\n";
  for (std::size_t g = 0; g < groups.size(); ++g) {
    csv += csv_field(groups[g]);
    for (std::size_t h = 0; h < groups.size(); ++h)
      csv += fmt::format(",{}", g == h ? areas.alone[g] : areas.buried[g * groups.size() + h]);
    csv += "\n";
  }
  return csv;
}

}  // namespace bihive::cli
