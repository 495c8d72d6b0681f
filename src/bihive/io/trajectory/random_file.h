// A file, or bytes in memory, of which parts are read from any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

class RandomFile {
 public:
  /// A regular file. Errors: missing, a folder, a pipe, unreadable.
  static Result<RandomFile> open(const std::string& path);
  /// Bytes that must outlive it; `name` is for messages.
  static RandomFile of_bytes(std::string_view bytes, const std::string& name);
  ~RandomFile();
  RandomFile(RandomFile&& other) noexcept;
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(RandomFile&&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;

  const std::string& path() const { return path_; }
  /// Bytes when it was opened.
  std::int64_t size() const { return size_; }
  /// `count` bytes from `place` on. Errors: the file ends before, it cannot be read, or there is no memory for them.
  Result<std::string> read(std::int64_t place, std::int64_t count) const;

 private:
  RandomFile() = default;

  std::string path_;
  int file_ = -1;  // below 0: the bytes
  std::string_view bytes_;
  std::int64_t size_ = 0;
};

}  // namespace bihive
