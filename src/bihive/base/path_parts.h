// Parts of a path.
#pragma once

#include <string>

namespace bihive {

/// The folder of a path: "." for a name alone.
std::string folder_of(const std::string& path);
/// The name of a path in its folder.
std::string name_in_folder(const std::string& path);
/// ".png" of "run/A.PNG", in lower case; empty: none.
std::string ending_of(const std::string& path);

}  // namespace bihive
