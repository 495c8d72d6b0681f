#include "bihive/viewer/pick.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "bihive/geometry/sphere_set.h"
#include "bihive/io/elements.h"
#include "bihive/select/attribute_names.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

ordered_json place_json(Vec3d place) {
  return {place.x, place.y, place.z};
}

ordered_json value_json(const FoundAttribute& attribute, const SphereSet& spheres, std::int64_t id) {
  if (attribute.texts != nullptr) return attribute.texts->of(static_cast<std::size_t>(spheres.stored_id(id)));
  if (attribute.is_element()) return element_symbol(static_cast<int>(attribute.number_of(spheres, id)));
  const double number = attribute.number_of(spheres, id);
  if (!std::isfinite(number)) return nullptr;
  if (number == std::floor(number) && std::abs(number) < 9007199254740992) return static_cast<std::int64_t>(number);
  return number;
}

}  // namespace

std::optional<std::int64_t> shown_id(const Scene& scene, std::int64_t id_in_input) {
  const std::int64_t of_input = scene.id_in_input.empty() ? scene.spheres.size() : scene.size_of_input;
  if (id_in_input < 0 || of_input == 0) return std::nullopt;
  const std::int64_t copy = id_in_input / of_input;
  std::int64_t stored = id_in_input % of_input;
  if (!scene.id_in_input.empty()) {
    const auto at = std::lower_bound(scene.id_in_input.begin(), scene.id_in_input.end(), stored);
    if (at == scene.id_in_input.end() || *at != stored) return std::nullopt;
    stored = at - scene.id_in_input.begin();
  }
  if (copy >= scene.spheres.images().count()) return std::nullopt;
  return copy * scene.spheres.size() + stored;
}

std::string picked_to_json(const Picked& picked, const Scene& scene) {
  const SphereSet& spheres = scene.spheres;
  ordered_json json;
  json["sphere"] = picked.sphere;
  json["point"] = place_json(picked.point);
  json["distance"] = picked.distance;
  json["centre"] = place_json(spheres.centre(picked.sphere));
  json["radius"] = spheres.radius(picked.sphere);
  json["attributes"] = ordered_json::object();
  for (const std::string& name : attribute_names(spheres)) {
    const FoundAttribute attribute = find_attribute(spheres, name);
    using Number = FoundAttribute::Number;
    const Number number = attribute.number;
    if (number == Number::x || number == Number::y || number == Number::z || number == Number::radius) continue;
    json["attributes"][name] = value_json(attribute, spheres, picked.sphere);
  }
  return json.dump(-1, ' ', /*ensure_ascii=*/false, ordered_json::error_handler_t::replace);
}

}  // namespace bihive
