#include "commands/measure_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

std::string table_of_cavities(const SphereSet& spheres, const std::vector<Cavity>& cavities) {
  const SphereAttributes& attributes = spheres.attributes();
  const NamedTexts* const names = attributes.find_texts("resname");
  const NamedTexts* const chains = attributes.find_texts("chain");
  const NamedTexts* const insertions = attributes.find_texts("insertion");
  const NamedNumbers* const numbers = attributes.find_numbers("resid");
  const bool has_residues = names != nullptr && numbers != nullptr;
  std::string csv = has_residues ? "volume,area,spheres,residues\n" : "volume,area,spheres\n";
  for (const Cavity& cavity : cavities) {
    csv += fmt::format("{},{},", cavity.volume, cavity.area);
    for (std::size_t i = 0; i < cavity.spheres.size(); ++i)
      csv += fmt::format("{}{}", i > 0 ? " " : "", cavity.spheres[i]);
    if (has_residues) {
      // Each residue once, in the order of its first sphere.
      std::vector<std::string> residues;
      for (const std::int64_t sphere : cavity.spheres) {
        const auto id = static_cast<std::size_t>(sphere);
        const std::string chain = chains != nullptr && !chains->of(id).empty() ? chains->of(id) + ":" : "";
        std::string residue = fmt::format("{}{}{}{}", chain, names->of(id), numbers->values[id],
                                          insertions != nullptr ? insertions->of(id) : "");
        if (std::find(residues.begin(), residues.end(), residue) == residues.end())
          residues.push_back(std::move(residue));
      }
      csv += "," + csv_field(fmt::format("{}", fmt::join(residues, " ")));
    }
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
