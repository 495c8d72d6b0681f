// "Did you mean": the known name nearest to an unknown one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bihive {

/// The candidate that differs least from the name, by letters that are changed, added, removed or swapped, without
/// regard to case; empty if none is near.
std::string near_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace bihive
