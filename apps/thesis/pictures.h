// Helpers for the experiments that draw pictures.
#pragma once

#include <optional>
#include <string>

#include "bihive/render/renderer.h"
#include "experiment.h"
#include "support/values.h"

namespace bihive::thesis {

/// width_px and height_px of values.json; a quick run divides both.
cli::PictureSize picture_size(const Settings& settings, const Values& values, int quick_divisor);

/// The scene's own settings, at this size, in this view.
RenderSettings picture_settings(const StepContext& context, const Scene& scene, cli::PictureSize size, View view);

/// Nothing if cancelled; fails on an error. `rays`: of all generations, counted.
std::optional<Image> draw(const StepContext& context, const Scene& scene, const Tracer& tracer,
                          const RenderSettings& settings, std::int64_t* rays = nullptr);

/// Writes the picture into the experiment's folder. Returns data for the step's result: name, size, hash, and number of
/// colours.
Json write_picture(const StepContext& context, const std::string& name, const Image& image);

std::vector<double> numbers_of(Vec3d vector);

/// The number of spheres that have exactly the centre of another one, with a smaller id.
std::int64_t coinciding_spheres(const SphereSet& spheres);

}  // namespace bihive::thesis
