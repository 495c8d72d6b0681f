// Default colours and units of spheres from a file.
#pragma once

#include <string_view>

#include "bihive/scene/scene.h"
#include "bihive/scene/style.h"

namespace bihive {

/// Colours spheres without colours by element (or as the style colours atoms), else by type, else as the style says,
/// and notes it in Scene::coloured_by. Scene::length_unit becomes that of the format (`format`: as SphereFile::format).
/// `style`: null: plain.
void take_default_colours(Scene& scene, std::string_view format, const Style* style);

}  // namespace bihive
