#include "server/named_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace bihive::cli {

Result<std::shared_ptr<const OpenFile>> OpenFile::open(const std::string& path) {
  // Opening a pipe without a writer must not block.
  Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!descriptor) return Error{std::strerror(errno), path, 0, 0, ""};
  const std::shared_ptr<OpenFile> file(new OpenFile(std::move(descriptor)));
  struct stat facts {};
  if (fstat(file->descriptor_.get(), &facts) != 0) return Error{std::strerror(errno), path, 0, 0, ""};
  if (S_ISDIR(facts.st_mode)) return Error{std::strerror(EISDIR), path, 0, 0, ""};
  if (!S_ISREG(facts.st_mode)) return Error{"only a regular file can be shown in the page", path, 0, 0, ""};
  file->size_ = static_cast<std::uint64_t>(facts.st_size);
  file->version_ =
      fmt::format("{:x}-{:x}-{:x}-{:x}", facts.st_ino, facts.st_size, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec);
  return std::shared_ptr<const OpenFile>(file);
}

std::size_t OpenFile::read(std::uint64_t offset, char* bytes, std::size_t count) const {
  ssize_t taken = -1;
  do taken = pread(descriptor_.get(), bytes, count, static_cast<off_t>(offset));
  while (taken < 0 && errno == EINTR);
  return taken > 0 ? static_cast<std::size_t>(taken) : 0;
}

}  // namespace bihive::cli
