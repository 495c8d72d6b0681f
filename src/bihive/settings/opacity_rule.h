// How often a sphere attenuates a ray that passes straight through it.
#pragma once

namespace bihive {

/// Rays pass straight through a sphere if its opacity is below 1, or if its material is transmissive with index 1.
///
/// each_surface: the ray continues at both surfaces, as a generation of its own, and each surface transmits the
/// transmissive share; such a sphere casts a full shadow. This is Whitted's rule [Whitted1980] and the thesis's. once:
/// both surfaces together transmit that share, once, and it does not count as a generation; shadow rays and rays of
/// ambient occlusion are attenuated by the same share. Refracting spheres transmit shadow rays straight, with their own
/// share. first: as `once`, but of all spheres of one class of opacity a ray crosses the first alone, without a tint,
/// so that they look like one hollow body; others of their class do not exist for this ray. Refracting spheres are in
/// no class. as_one: as `first`, but a ray crosses each class each time that it enters the union of its spheres: those
/// that it enters inside of another one of their class do not count. So overlapping spheres look like one solid body.
enum class OpacityRule { each_surface, once, first, as_one };

/// With OpacityRule::first and as_one: the class, 0 to 15, of a sphere that transmits this share straight, above 0 up
/// to 1. Spheres whose opacities lie within the same sixteenth are in one class.
constexpr int kOpacityClasses = 16;
inline int opacity_class(double share) {
  const int sixteenth = static_cast<int>(kOpacityClasses * share);
  return sixteenth < kOpacityClasses ? sixteenth : kOpacityClasses - 1;
}

/// Rays cross layers in every generation, so their number would be a power of the number of layers. Hence, in a scene
/// where another rule applies to some sphere, a reflected or refracted ray that carries less of a primary ray's light
/// than this is not traced: less than 1/8 of a step of an 8-bit picture in linear light. Nor is a sphere that a ray
/// passes straight through shaded where less than this arrives at it.
constexpr double kFaintestRay = 1.0 / 2048;

}  // namespace bihive
