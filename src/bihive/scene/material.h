// The reflectance of a surface: the columns of the thesis's Table 4.1.
#pragma once

#include "bihive/math/vec3.h"

namespace bihive {

/// Shares are dimensionless and at least 0; nothing requires them to sum to 1. A reflective or transmissive share of
/// exactly 0 makes no ray. `colour` is linear RGB and tints the ambient and diffuse terms only.
struct Material {
  Vec3d colour{1, 1, 1};
  double ambient = 0;
  double diffuse = 0;
  double reflective = 0;
  double specular = 0;
  double power = 1;  ///< Phong exponent, > 0
  double transmissive = 0;
  double refraction_index = 1;  ///< relative to the outside; > 0 if transmissive > 0
  double tint = 0;              ///< of the highlight: 0 = the light's colour, 1 = times the material's colour, as for
                                ///< metals
  double glow = 0;              ///< emission, as a fraction of its colour
  int bands = 0;                ///< steps to which diffuse light is quantized; 0 = smooth
};

/// Whether tint, bands or glow, which the thesis does not have, affect its shading.
inline bool has_effects(const Material& material) {
  return material.tint != 0 || material.bands != 0 || material.glow != 0;
}

/// Whether light passes straight through it, unrefracted.
inline bool is_passed_straight(const Material& material) {
  return material.transmissive > 0 && material.refraction_index == 1;
}

/// Table 4.1.
inline Material red_material() {
  return {{0.9, 0.3, 0.3}, 0.30, 0.30, 0.30, 0.10, 40, 0.00, 0.00};
}
inline Material transparent_material() {
  return {{1, 1, 1}, 0.10, 0.10, 0.00, 0.10, 50, 0.70, 0.95};
}

/// The material of spheres from a file, unless a scene has another: matte with a soft highlight, no further rays. With
/// it a white sphere lit from the front reaches 1, and its shadowed side stays readable.
inline Material matte_material() {
  return {{1, 1, 1}, 0.30, 0.70, 0.00, 0.15, 40, 0.00, 1.00};
}

}  // namespace bihive
