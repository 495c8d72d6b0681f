// Unpacks gzip in memory.
#pragma once

#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// True if the bytes begin like a gzip file.
bool looks_gzipped(std::string_view bytes);

/// Unpacks all members of a gzip file in a row; zeros behind the last member are padding. Errors: cut or damaged data,
/// no memory left, or a build without zlib. `name` is for messages. Memory grows with the unpacked bytes only.
Result<std::string> gunzip(std::string_view bytes, const std::string& name);

}  // namespace bihive
