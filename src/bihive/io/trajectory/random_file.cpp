#include "bihive/io/trajectory/random_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

namespace bihive {

Result<RandomFile> RandomFile::open(const std::string& path) {
  RandomFile file;
  file.path_ = path;
  file.file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file.file_ < 0) return Error{std::string("it cannot be read: ") + std::strerror(errno), path, 0, 0, ""};
  struct stat facts = {};
  if (fstat(file.file_, &facts) != 0) return Error{std::strerror(errno), path, 0, 0, ""};
  if (!S_ISREG(facts.st_mode))
    return Error{"this is no file whose frames can be read in any order", path, 0, 0, "write it to a file first"};
  file.size_ = facts.st_size;
  return file;
}

RandomFile RandomFile::of_bytes(std::string_view bytes, const std::string& name) {
  RandomFile file;
  file.path_ = name;
  file.bytes_ = bytes;
  file.size_ = static_cast<std::int64_t>(bytes.size());
  return file;
}

RandomFile::~RandomFile() {
  if (file_ >= 0) close(file_);
}

RandomFile::RandomFile(RandomFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), bytes_(other.bytes_), size_(other.size_) {}

Result<std::string> RandomFile::read(std::int64_t place, std::int64_t count) const {
  const auto ends = [&] { return Error{"the file ends too early", path_, 0, 0, "it may be cut"}; };
  if (place < 0 || count < 0 || place > size_ || count > size_ - place) return ends();
  try {
    if (file_ < 0) return std::string(bytes_.substr(static_cast<std::size_t>(place), static_cast<std::size_t>(count)));
    std::string bytes(static_cast<std::size_t>(count), '\0');
    for (std::size_t have = 0; have < bytes.size();) {
      const ssize_t n = pread(file_, bytes.data() + have, bytes.size() - have, place + static_cast<off_t>(have));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return Error{std::string("it cannot be read: ") + std::strerror(errno), path_, 0, 0, ""};
      if (n == 0) return ends();
      have += static_cast<std::size_t>(n);
    }
    return bytes;
  } catch (const std::bad_alloc&) {
    return Error{"there is not enough memory to read it", path_, 0, 0, ""};
  }
}

}  // namespace bihive
