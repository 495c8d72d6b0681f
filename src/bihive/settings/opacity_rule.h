// How often a sphere takes light from a ray that it lets straight through.
#pragma once

namespace bihive {

/// A sphere is passed straight if its opacity is below 1, or if its material is transmissive with index 1.
///
/// each_surface: the ray goes on at each of both surfaces, as a generation of its own, and either surface lets the
/// transmissive share through; such a sphere throws a full shadow. It is Whitted's rule [Whitted1980] and the thesis's.
/// once: both surfaces together let that share through, once, outside the count of generations; and shadow rays and
/// rays of ambient occlusion pass with the same share. Refracting spheres let shadow rays pass straight with theirs.
enum class OpacityRule { each_surface, once };

/// Rays cross layers in every generation, so their number would be a power of the number of layers. Hence, in a scene
/// where a sphere is passed straight once, a reflected or refracted ray that carries less of a primary ray's light than
/// this is not followed: less than 1/8 of a step of an 8-bit picture in linear light.
constexpr double kFaintestRay = 1.0 / 2048;

}  // namespace bihive
