#include "bihive/base/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace bihive {
namespace {

Error system_error(const std::string& what, const std::string& path, int code, const std::string& hint = "") {
  return {what + ": " + std::strerror(code), path, 0, 0, hint};
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

// The file at the end of the path's links, so that a link is followed and not replaced. A path to nothing stays as it
// is.
std::string follow_links(const std::string& path) {
  char resolved[PATH_MAX];
  return realpath(path.c_str(), resolved) != nullptr ? std::string(resolved) : path;
}

// Writes everything; returns 0, or the errno of the failure.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

Result<GrowingFile> GrowingFile::begin(const std::string& given_path) {
  if (Status status = check_writable(given_path); !status) return status.error();
  GrowingFile growing;
  growing.given_path_ = given_path;
  growing.path_ = follow_links(given_path);
  struct stat info {};
  const bool exists = ::stat(growing.path_.c_str(), &info) == 0;
  if (exists && !S_ISREG(info.st_mode)) {
    // A pipe or a device: a rename would replace it.
    growing.file_ = ::open(growing.path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (growing.file_ < 0) return system_error("cannot be written", given_path, errno);
    return growing;
  }

  // Make a file with a new name in the folder of the target, so that the rename stays on one disk.
  std::string aside = growing.path_ + ".XXXXXX";
  growing.file_ = ::mkstemp(aside.data());
  if (growing.file_ < 0) return system_error("cannot be created", given_path, errno);
  growing.aside_ = std::move(aside);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  growing.mode_ = exists ? (info.st_mode & 07777) : (0666 & ~mask);
  return growing;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      size_(other.size_),
      mode_(other.mode_),
      given_path_(std::move(other.given_path_)),
      path_(std::move(other.path_)),
      aside_(std::exchange(other.aside_, std::string())) {}

GrowingFile::~GrowingFile() {
  if (file_ >= 0) ::close(file_);
  if (!aside_.empty()) ::unlink(aside_.c_str());
}

Status GrowingFile::failed(int code) {
  return system_error("writing failed", given_path_, code,
                      code == ENOSPC && !aside_.empty() ? "free some space or write elsewhere" : "");
}

Status GrowingFile::append(std::string_view bytes) {
  if (const int code = write_all(file_, bytes); code != 0) return failed(code);
  size_ += bytes.size();
  return Done{};
}

Status GrowingFile::write_at(std::uint64_t place, std::string_view bytes) {
  if (place == size_) return append(bytes);
  if (aside_.empty()) return failed(ESPIPE);
  if (::lseek(file_, static_cast<off_t>(place), SEEK_SET) < 0) return failed(errno);
  if (const int code = write_all(file_, bytes); code != 0) return failed(code);
  size_ = std::max(size_, place + bytes.size());
  if (::lseek(file_, static_cast<off_t>(size_), SEEK_SET) < 0) return failed(errno);
  return Done{};
}

Status GrowingFile::finish() {
  // Flush, rename. The destructor removes the new file after any failure.
  int code = 0;
  const bool is_aside = !aside_.empty();
  if (is_aside && ::fchmod(file_, static_cast<mode_t>(mode_)) != 0) code = errno;
  if (is_aside && code == 0 && ::fsync(file_) != 0) code = errno;
  if (::close(std::exchange(file_, -1)) != 0 && code == 0) code = errno;
  if (is_aside && code == 0 && ::rename(aside_.c_str(), path_.c_str()) != 0) code = errno;
  if (code != 0) return failed(code);
  aside_.clear();
  return Done{};
}

Status write_file(const std::string& path, std::string_view bytes) {
  Result<GrowingFile> file = GrowingFile::begin(path);
  if (!file) return file.error();
  if (Status status = file->append(bytes); !status) return status;
  return file->finish();
}

Status check_writable(const std::string& given_path) {
  if (given_path.empty()) return Error{"the output path is empty", "", 0, 0, "name a file"};
  const std::string path = follow_links(given_path);
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) {
    if (S_ISDIR(info.st_mode)) return Error{"is a folder", given_path, 0, 0, "name a file in it"};
    if (::access(path.c_str(), W_OK) != 0) return system_error("cannot be written", given_path, errno);
    if (!S_ISREG(info.st_mode)) return Done{};
  } else if (errno != ENOENT) {
    return system_error("cannot be written", given_path, errno);
  }
  const std::string folder = folder_of(path);
  if (::stat(folder.c_str(), &info) != 0)
    return system_error("the folder " + folder + " cannot be used", given_path, errno, "make the folder first");
  if (!S_ISDIR(info.st_mode)) return Error{folder + " is not a folder", given_path, 0, 0, ""};
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return system_error("the folder " + folder + " cannot be written to", given_path, errno);
  return Done{};
}

Result<std::string> read_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return system_error("cannot be opened", path, errno);
  struct stat info {};
  std::string bytes;
  int code = ::fstat(file, &info) == 0 ? 0 : errno;
  if (code == 0 && S_ISDIR(info.st_mode)) {
    ::close(file);
    return Error{"is a folder, not a file", path, 0, 0, "name a file"};
  }

  // Read to the end. The size is only a hint: a pipe has none, and a file may grow.
  if (code == 0 && info.st_size > 0) bytes.reserve(static_cast<std::size_t>(info.st_size));
  std::string buffer(1 << 16, '\0');
  while (code == 0) {
    const ssize_t count = ::read(file, buffer.data(), buffer.size());
    if (count == 0) break;
    if (count > 0) bytes.append(buffer, 0, static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) code = errno;
  }
  ::close(file);
  if (code != 0) return system_error("cannot be read", path, code);
  return bytes;
}

}  // namespace bihive
