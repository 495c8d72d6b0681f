// A limit of distances that is most likely in a wrong unit.
#pragma once

#include "bihive/base/result.h"
#include "bihive/wide/periodic_images.h"

namespace bihive::wide {

/// Error: a limit, in stored units, that reaches more than a million images of one sphere; the lists would fill the
/// memory.
Status check_reach(const PeriodicImages& images, double limit);

}  // namespace bihive::wide
