// The colour of a number after colour_by() (scene/colour_by.h).
#pragma once

#include "bihive/scene/colour_by.h"

namespace bihive {

/// `done` is what colour_by() returned. Not for elements.
Vec3f colour_of_number(const ColourBy& done, double number, Transfer transfer);

}  // namespace bihive
