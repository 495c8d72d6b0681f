// Materials with names.
#pragma once

#include "bihive/scene/material.h"
#include "bihive/scene/names.h"

namespace bihive {

/// matte: no highlight. plastic: a small white highlight. metal: a wide one of its own colour, and a faint mirror.
/// glass: mostly clear, refracting. flat: its colour alone, no light and no shadow. toon: light in three steps.
const Names<Material>& named_materials();

}  // namespace bihive
