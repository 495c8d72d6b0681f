// Writes files whole or not at all.
#pragma once

#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// Writes the bytes to a new file beside `path`, flushes it to the disk, and renames it to `path`. So a reader sees the
/// old file or the whole new one. A symbolic link is followed. A pipe, a device or another file that is not regular is
/// written directly. After an error (missing folder, no permission, full disk) no partial file is left.
Status write_file(const std::string& path, std::string_view bytes);

/// An error if write_file(path) would surely fail now (missing folder, a folder in its place, no permission). Call it
/// before long work, so that the user sees the error at once.
Status check_writable(const std::string& path);

/// The whole file. Errors: missing, a folder, unreadable.
Result<std::string> read_file(const std::string& path);

}  // namespace bihive
