// Quantities of the frame rates in section F of the text, at given costs of the steps of a ray.
#pragma once

#include "bihive/thesis/cost_model.h"
#include "values.h"

namespace bihive::thesis {

/// The quantities that the claims of Figure 4.4 compare: who wins where, the shapes of the curves over MAX_PRIMS, the
/// extremes, the gains. Their names are those of the claims' "of" in thesis/figure-4.4/values.json, after "at.text.".
Json quantities_at(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs, const Values& values);

}  // namespace bihive::thesis
