// From a selection's tree to the spheres of one set that it means.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/select/expression.h"

namespace bihive {

/// One byte for each sphere: 1 selected, 0 not.
using SphereMask = std::vector<std::uint8_t>;

/// `text` is the selection's, for the places in errors. Errors: a name that the set does not have, a value of the wrong
/// kind, a word whose columns are missing.
Result<SphereMask> evaluate(const Expression& expression, std::string_view text, const SphereSet& spheres);

}  // namespace bihive
