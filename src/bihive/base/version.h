// The version of bihive. The build generates the definitions.
#pragma once

#include <string_view>

namespace bihive {

/// "major.minor.patch".
std::string_view version();

/// The abbreviated git commit, with "-dirty" if the sources differed from it; empty if the build did not know it.
std::string_view commit();

}  // namespace bihive
