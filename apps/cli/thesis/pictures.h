// Helpers for the experiments that draw pictures.
#pragma once

#include <optional>
#include <string>

#include "bihive/render/renderer.h"
#include "support/values.h"
#include "thesis/experiment.h"

namespace bihive::cli::thesis {

/// width_px and height_px of values.json; a quick run divides both.
PictureSize picture_size(const Settings& settings, const Values& values, int quick_divisor);

/// The scene's own settings, at this size, in this view.
RenderSettings picture_settings(const StepContext& context, const Scene& scene, PictureSize size, View view);

/// Nothing if cancelled; fails on an error.
std::optional<Image> draw(const StepContext& context, const Scene& scene, const Tracer& tracer,
                          const RenderSettings& settings);

/// Writes the picture into the experiment's folder. Returns data for the step's result: name, size, hash, and number of
/// colours.
Json write_picture(const StepContext& context, const std::string& name, const Image& image);

/// The result of write_picture() as an illustration of this experiment.
Illustration illustration_of(const std::string& experiment, const Json& picture, const std::string& caption);

/// "(0, -20, 0)".
std::string vector_text(const std::vector<double>& numbers);
std::vector<double> numbers_of(Vec3d vector);

}  // namespace bihive::cli::thesis
