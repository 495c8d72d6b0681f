// The reading half of write_file.h.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <new>

#include "bihive/base/memory.h"
#include "bihive/base/open_file.h"
#include "bihive/base/output_place.h"
#include "bihive/base/watch.h"
#include "bihive/base/write_file.h"

namespace bihive {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;
constexpr std::size_t kLeastRoom = std::size_t{1} << 20;

// Bytes at `to`; 0 at the end of the file, -1 after an error.
ssize_t read_some(int file, char* to, std::size_t count) {
  ssize_t got = 0;
  do got = ::read(file, to, count);
  while (got < 0 && errno == EINTR);
  return got;
}

// May throw, where memory is short.
Result<std::string> read_open_file(int file, const std::string& name, bool* grew) {
  if (grew != nullptr) *grew = false;
  struct stat info {};
  if (::fstat(file, &info) != 0) return system_error("cannot be read", name, errno);
  if (S_ISDIR(info.st_mode)) return Error{"is a folder, not a file", name, 0, 0, "name a file", EISDIR};

  // The size at the beginning counts: a file that grows faster than it is read would have no end. Files of /proc, pipes
  // and devices state no size.
  const bool has_size = S_ISREG(info.st_mode) && info.st_size > 0;
  std::uint64_t most = UINT64_MAX;
  if (has_size) {
    const off_t place = ::lseek(file, 0, SEEK_CUR);
    most = static_cast<std::uint64_t>(std::max<off_t>(0, info.st_size - std::max<off_t>(0, place)));
    if (Status status = check_memory(static_cast<double>(most), "the file"); !status) {
      Error error = status.error();
      error.file = name;
      return error;
    }
  }

  // Read piece by piece, up to that size. Where none is stated, the buffer grows by a quarter at a time before it is
  // full: while the bytes move, the old and the new buffer both take memory.
  std::string bytes;
  if (has_size) bytes.reserve(static_cast<std::size_t>(most));
  std::string piece(kPiece, '\0');
  WatchedWork work;
  while (true) {
    if (work.cancelled()) return cancelled_error();
    const std::uint64_t left = most - bytes.size();
    const ssize_t count =
        read_some(file, piece.data(), static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, left)));
    if (count < 0) return system_error("cannot be read", name, errno);
    if (count == 0) break;
    if (!has_size && bytes.capacity() - bytes.size() < static_cast<std::size_t>(count)) {
      const std::size_t room = std::max(kLeastRoom, bytes.size() / 4 * 5 + kPiece);
      if (Status status = check_memory(static_cast<double>(room), "what is read", static_cast<double>(bytes.size()));
          !status) {
        Error error = status.error();
        error.file = name;
        return error;
      }
      bytes.reserve(room);
    }
    bytes.append(piece, 0, static_cast<std::size_t>(count));
  }
  // One byte more tells whether it has grown.
  if (has_size && grew != nullptr && bytes.size() == most) {
    char more = 0;
    *grew = read_some(file, &more, 1) > 0;
  }
  return bytes;
}

}  // namespace

Result<std::string> read_descriptor(int file, const std::string& name, bool* grew) {
  try {
    return read_open_file(file, name, grew);
  } catch (const std::bad_alloc&) {
    return Error{no_memory_for("reading it").message, name, 0, 0, ""};
  }
}

Result<std::string> read_file(const std::string& path, bool* grew) {
  if (path.empty()) return Error{"the path is empty", "", 0, 0, "name a file"};
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0) return system_error("cannot be opened", path, errno);
  return read_descriptor(file.get(), path, grew);
}

}  // namespace bihive
