// Colours of sticks that have numbers of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// An error with the name of its setting in front.
Error error_of_setting(const std::string& setting, const Error& error);

/// The colour of each row that the mask takes; empty where the text is: then the spheres' own. `rows`: a set whose
/// attributes are the numbers of the rows. `setting`: the id of the setting whose value the text is: a colour, or an
/// attribute with a map and a range. Sets `how` in the second case.
Result<std::vector<Vec3f>> stick_colours(const SphereSet& rows, const Scene& scene, const std::string& setting,
                                         const std::string& text, const std::vector<std::uint8_t>& mask,
                                         std::optional<ColourBy>& how);

}  // namespace bihive
