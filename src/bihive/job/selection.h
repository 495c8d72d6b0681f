// A selection on the command line: its spheres, or a failure that shows the faulty column.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Fails with kBadUsage: the message, then the expression with a caret below the faulty column. `setting`: the id of
/// the option or argument.
[[noreturn]] void fail_selection(const std::string& setting, const std::string& expression, const Error& error);

/// The expression's mask over the spheres; fails as above.
std::vector<std::uint8_t> selected_or_fail(const SphereSet& spheres, const std::string& expression,
                                           const std::string& setting);

}  // namespace bihive
