// FILE:/GROUP/NAME: a data set within a file.
#pragma once

#include <string>

namespace bihive {

struct DataPath {
  std::string file;
  std::string inside;  ///< "/group/name"; empty: the path names a file as a whole
};

/// A path is that of a file as a whole, unless there is none of that name and one of the name before ":/".
DataPath data_path(const std::string& path);

}  // namespace bihive
