#include "support/ranks_here.h"

#include "bihive/spread/sphere_columns.h"

namespace bihive::test {

Scene part_of_scene(const Scene& whole, int part, int parts) {
  const std::int64_t count = whole.spheres.size();
  std::vector<std::int64_t> own_ids, chosen;
  for (std::int64_t id = 0; id < count; ++id) own_ids.push_back(id);
  if (part < parts)
    for (std::int64_t id = count * part / parts; id < count * (part + 1) / parts; ++id) chosen.push_back(id);
  Bytes packed;
  pack_spheres(whole, SphereColumns::of(whole), own_ids, chosen, packed);
  Scene made = without_spheres(whole);
  ByteReader reader(packed);
  append_spheres(reader, SphereColumns::of(whole), made, own_ids);
  return made;
}

}  // namespace bihive::test
