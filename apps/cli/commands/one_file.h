// The page as one file, with engine and data inside: scripts/build_one_file makes it, without data.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive::cli {

/// The initial state of the page.
struct OneFileData {
  std::string state;            ///< JSON, as in start.json; its source names the files
  std::string file_name;        ///< empty: the source is built in
  std::string file;             ///< its bytes
  std::string trajectory_name;  ///< empty: there is none
  std::string trajectory;       ///< its bytes
};

/// The page with the data in its places, as "Save as page" fills them (web/src/one_file.ts). Errors: `page` is of
/// another version.
Result<std::string> one_file_with(const std::string& page, const OneFileData& data);

}  // namespace bihive::cli
