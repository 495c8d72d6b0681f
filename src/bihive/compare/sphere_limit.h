// Shared by all builders: refuses more spheres than indices can number, and turns a lack of memory into an Error.
#pragma once

#include <limits>
#include <new>
#include <string>

#include "bihive/base/readable.h"
#include "bihive/compare/structure.h"

namespace bihive::workbench {

/// Calls make(), which returns a StructurePointer, with so few spheres that 32 bits number `entries` for each.
/// bad_alloc becomes an Error.
template <class Make>
Result<StructurePointer> build_or_error(const SphereSet& spheres, const char* name, const Make& make,
                                        std::int64_t entries = 1) {
  const std::int64_t most = std::numeric_limits<std::uint32_t>::max() / entries;
  if (spheres.size() > most)
    return Error{
        std::string(name) + " numbers at most " + grouped(most) + " spheres; there are " + grouped(spheres.size()), "",
        0, 0, ""};
  try {
    return make();
  } catch (const std::bad_alloc&) {
    return Error{std::string(name) + ": not enough memory for " + grouped(spheres.size()) + " spheres", "", 0, 0, ""};
  }
}

}  // namespace bihive::workbench
