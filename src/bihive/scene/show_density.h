// Styles for points by their density, on a scene that was loaded.
#pragma once

#include <optional>

#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"

namespace bihive {

/// Gives the spheres the style's values for them, if it is such a style and there are spheres, and says so in
/// LoadedScene::rules. A file's radii and opacities stay.
void take_density(LoadedScene& loaded, const Style& style);

/// Replaces the radii and opacities that a style gave the spheres. Unset: restores those that they had before. A film
/// shows all its frames with the values of the first.
void show_density(LoadedScene& loaded, const std::optional<Density>& density);

}  // namespace bihive
