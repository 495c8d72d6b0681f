// Styles for points by their density, on a scene that was loaded.
#pragma once

#include <optional>

#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"

namespace bihive {

/// Gives the spheres the style's values for them, if it is such a style and there are spheres, and says so in
/// LoadedScene::rules. A file's radii and opacities stay.
void take_density(LoadedScene& loaded, const Style& style);

/// The spheres get these values in place of those that they have from a style; unset: what they had without it. For
/// frames of a film, which has those of its first one.
void show_density(LoadedScene& loaded, const std::optional<Density>& density);

}  // namespace bihive
