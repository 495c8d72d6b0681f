#include "bihive/scene/creases.h"

#include <cmath>
#include <map>

#include "bihive/select/attribute_names.h"

namespace bihive {

Result<std::vector<std::int32_t>> crease_groups(const SphereSet& spheres, const std::string& attribute) {
  const FoundAttribute found = find_attribute(spheres, attribute);
  if (!found.found())
    return Error{"there is no attribute \"" + attribute + "\"", "", 0, 0,
                 suggestion(attribute, attribute_names(spheres))};
  std::vector<std::int32_t> groups;
  std::map<double, std::int32_t> known;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    if (found.texts != nullptr) {
      groups.push_back(1 + found.texts->text_of_sphere[static_cast<std::size_t>(id)]);
      continue;
    }
    const double number = found.number_of(spheres, id);
    const auto next = static_cast<std::int32_t>(known.size() + 1);
    groups.push_back(std::isnan(number) ? 0 : known.try_emplace(number, next).first->second);
  }
  return groups;
}

}  // namespace bihive
