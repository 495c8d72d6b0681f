// In builds of readers alone, without measures.
#include "bihive/io/assemble/exposed_area.h"

namespace bihive {

Status add_exposed_area(const SphereSet& /* spheres */, const ReadOptions& options,
                        SphereAttributes& /* attributes */) {
  if (!options.exposed_area) return Done{};
  return Error{"this build of bihive measures no areas", "", 0, 0, ""};
}

}  // namespace bihive
