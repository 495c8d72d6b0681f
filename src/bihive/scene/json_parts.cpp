#include "bihive/scene/json_parts.h"

#include <nlohmann/json.hpp>

namespace bihive {
namespace {

using nlohmann::json;

// Leaves `target` alone if there is no such key.
template <class T>
void take_value(const json& object, const char* key, T& target) {
  target = object.value(key, target);
}

}  // namespace

Vec3d vector_from_json(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

void take_material(const json& value, Transfer transfer, Material& material) {
  if (value.contains("colour")) material.colour = colour_from_json(value.at("colour"), transfer);
  take_value(value, "ambient", material.ambient);
  take_value(value, "diffuse", material.diffuse);
  take_value(value, "reflective", material.reflective);
  take_value(value, "specular", material.specular);
  take_value(value, "power", material.power);
  take_value(value, "transmissive", material.transmissive);
  take_value(value, "refraction_index", material.refraction_index);
  take_value(value, "tint", material.tint);
  take_value(value, "bands", material.bands);
  take_value(value, "glow", material.glow);
}

}  // namespace bihive
