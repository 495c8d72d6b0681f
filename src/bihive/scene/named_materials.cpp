#include "bihive/scene/named_materials.h"

namespace bihive {
namespace {

Material lit(double share) {
  Material material;
  material.ambient = share;
  material.diffuse = share;
  return material;
}

Material shiny(Material material, double specular, double power) {
  material.specular = specular;
  material.power = power;
  return material;
}

Material metal() {
  Material material = shiny(lit(0.75), 0.9, 14);
  material.tint = 0.85;
  material.reflective = 0.12;
  return material;
}

Material glass() {
  Material material = shiny(lit(0.12), 0.7, 150);
  material.reflective = 0.06;
  material.transmissive = 0.82;
  material.refraction_index = 1.3;
  return material;
}

Material flat() {
  Material material;
  material.glow = 1;
  return material;
}

Material toon() {
  Material material = lit(1);
  material.bands = 3;
  return material;
}

}  // namespace

const Names<Material>& named_materials() {
  static const Names<Material> materials{{"matte", lit(1)},  {"plastic", shiny(lit(0.95), 0.35, 60)},
                                         {"metal", metal()}, {"glass", glass()},
                                         {"flat", flat()},   {"toon", toon()}};
  return materials;
}

}  // namespace bihive
