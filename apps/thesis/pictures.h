// Helpers for the experiments that draw pictures.
#pragma once

#include <optional>
#include <string>

#include "bihive/render/renderer.h"
#include "bihive/scene/camera.h"
#include "experiment.h"

namespace bihive::thesis {

/// The scene's own settings in this view, with width_px and height_px of values.json; a quick run divides both.
RenderSettings picture_settings(const Experiment& experiment, const Scene& scene, View view, int quick_divisor = 4);

/// Nothing if cancelled; fails on an error. `rays`: of all generations, counted.
std::optional<Image> draw(const Experiment& experiment, const Scene& scene, const Tracer& tracer,
                          const RenderSettings& settings, std::int64_t* rays = nullptr);

/// Writes the picture into the experiment's folder. Returns data for the step's result: name, size and hash.
Json write_picture(const Experiment& experiment, const std::string& name, const Image& image);

/// Calls of(pixel, ray) with the ray through the centre of each pixel, row by row from the top.
template <class Of>
void for_each_ray(const Camera& camera, int width_px, int height_px, const Of& of) {
  const PixelRays rays(camera, width_px, height_px);
  std::size_t pixel = 0;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) of(pixel++, rays.at(x + 0.5, y + 0.5));
}

inline Json numbers_of(Vec3d vector) {
  return {vector.x, vector.y, vector.z};
}

/// The number of spheres that have exactly the centre of another one, with a smaller id.
std::int64_t coinciding_spheres(const SphereSet& spheres);

}  // namespace bihive::thesis
