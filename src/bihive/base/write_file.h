// Writes files whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// Writes the bytes to a new file beside `path`, flushes it to the disk, and renames it to `path`. So a reader sees the
/// old file or the whole new one. A symbolic link is followed. A pipe, a device or another file that is not regular is
/// written directly. After an error (missing folder, no permission, full disk) no partial file is left.
Status write_file(const std::string& path, std::string_view bytes);

/// A file that is written piece by piece, and is not seen under its path before it is whole: for files that are too
/// large for the memory. The rules of write_file() for paths hold here too.
class GrowingFile {
 public:
  /// Makes the new file beside `path`, or opens the pipe or the device.
  static Result<GrowingFile> begin(const std::string& path);
  /// A file that is not finished is removed.
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;

  /// Behind all bytes so far.
  Status append(std::string_view bytes);
  /// Over earlier bytes, or up to the end and beyond it. A pipe cannot go back: an Error.
  Status write_at(std::uint64_t place, std::string_view bytes);
  /// Flushes it to the disk and renames it to its path. The last call.
  Status finish();

  /// The path of the file until finish(); empty for a pipe or a device.
  const std::string& path_aside() const { return aside_; }

 private:
  GrowingFile() = default;
  Status failed(int code);

  int file_ = -1;
  std::uint64_t size_ = 0;
  unsigned mode_ = 0;
  std::string given_path_, path_, aside_;
};

/// An error if write_file(path) would surely fail now (missing folder, a folder in its place, no permission). Call it
/// before long work, so that the user sees the error at once.
Status check_writable(const std::string& path);

/// The whole file. Errors: missing, a folder, unreadable.
Result<std::string> read_file(const std::string& path);

}  // namespace bihive
