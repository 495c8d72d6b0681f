// A file, or bytes in memory, of which parts are read from any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "bihive/base/open_file.h"
#include "bihive/base/result.h"

namespace bihive {

/// What the system knows of a file: it changes with the file's content. Seconds and nanoseconds stand apart, as times
/// beyond 2262 have more nanoseconds than 64 bits hold.
struct FileStamp {
  std::int64_t written_s = 0, written_ns = 0;  ///< when its content was written last: anybody can set it
  std::int64_t changed_s = 0, changed_ns = 0;  ///< when content, name or owner changed last: the system alone sets it
  std::int64_t inode = 0;
};

class RandomFile {
 public:
  /// A regular file. Errors: missing, a folder, a pipe, unreadable.
  static Result<RandomFile> open(const std::string& path);
  /// Bytes that must outlive it; `name` is for messages.
  static RandomFile of_bytes(std::string_view bytes, const std::string& name);
  /// An open file.
  static RandomFile of_descriptor(Descriptor file, const std::string& name);
  /// Bytes of its own.
  static RandomFile of_owned(std::string bytes, const std::string& name);
  RandomFile(RandomFile&& other) noexcept = default;

  const std::string& path() const { return path_; }
  /// Bytes when it was opened.
  std::int64_t size() const { return size_; }
  /// Whether it is a file on the disk with its own path, not one that was unpacked or came through a pipe.
  bool has_path() const { return has_path_; }
  /// When it was opened; zeros for bytes in memory.
  const FileStamp& stamp() const { return stamp_; }
  /// Whether it is a file on the disk that became shorter or was written to since it was opened. One that only grew
  /// has the bytes that it had, as far as can be told from outside.
  bool changed() const;
  /// A new descriptor of the same file; none: the bytes are in memory.
  Descriptor another_descriptor() const;
  /// `count` bytes from `place` on. Errors: the file ends before, it cannot be read, or there is no memory for them.
  Result<std::string> read(std::int64_t place, std::int64_t count) const;
  /// The same into memory of the caller.
  Status read_into(std::int64_t place, std::int64_t count, char* to) const;

 private:
  RandomFile() = default;
  Status check_range(std::int64_t place, std::int64_t count) const;
  Error ends_early() const;

  std::string path_;
  Descriptor file_;  // none: the bytes
  std::unique_ptr<const std::string> owned_;
  std::string_view bytes_;
  std::int64_t size_ = 0;
  FileStamp stamp_;
  bool has_path_ = false;
};

}  // namespace bihive
