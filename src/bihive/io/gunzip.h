// Undoes gzip in memory.
#pragma once

#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// True where the bytes begin as a gzip file does.
bool looks_gzipped(std::string_view bytes);

/// All members of a gzip file, one behind the other; zeros behind the last are padding. Errors: cut or damaged data, or
/// a build without zlib. `name` is for messages. Memory grows with the unpacked bytes only.
Result<std::string> gunzip(std::string_view bytes, const std::string& name);

}  // namespace bihive
