// FILE of `bihive web`: the only file outside the page that can be fetched.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "bihive/base/open_file.h"
#include "bihive/base/result.h"

namespace bihive::cli {

/// A regular file, open for reading.
class OpenFile {
 public:
  /// Errors: missing, unreadable, not a regular file.
  static Result<std::shared_ptr<const OpenFile>> open(const std::string& path);

  std::uint64_t size() const { return size_; }
  /// Changes when the file is replaced or written.
  const std::string& version() const { return version_; }
  /// Reads up to `count` bytes from `offset` on. Returns their number; 0 at the end of the file and on errors.
  std::size_t read(std::uint64_t offset, char* bytes, std::size_t count) const;

 private:
  explicit OpenFile(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
  std::string version_;
};

}  // namespace bihive::cli
