// The version of bihive. The build generates the definitions.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// "major.minor.patch".
std::string_view version();

/// The abbreviated git commit, with "-dirty" if the sources differed from it; empty if the build did not know it.
std::string_view commit();

/// "0.2.0 (3db6e7b)", without a commit "0.2.0".
inline std::string version_with_commit(std::string_view of_version, std::string_view of_commit) {
  return std::string(of_version) + (of_commit.empty() ? "" : " (" + std::string(of_commit) + ")");
}

}  // namespace bihive
