#include "bihive/io/packed/random_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"

namespace bihive {
namespace {

// Between two looks at whether the reading is cancelled.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 24;

FileStamp stamp_of(const struct stat& facts) {
  return {facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec, facts.st_ctim.tv_sec, facts.st_ctim.tv_nsec,
          static_cast<std::int64_t>(facts.st_ino)};
}

Error unreadable(const std::string& path, int code) {
  return {std::string("it cannot be read: ") + std::strerror(code), path, 0, 0, "", code};
}

}  // namespace

Result<RandomFile> RandomFile::open(const std::string& path) {
  RandomFile file;
  file.path_ = path;
  file.file_ = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.file_) return unreadable(path, errno);
  struct stat facts = {};
  if (fstat(file.file_.get(), &facts) != 0) return unreadable(path, errno);
  if (!S_ISREG(facts.st_mode))
    return Error{"this is no file whose frames can be read in any order", path, 0, 0, "write it to a file first"};
  file.size_ = facts.st_size;
  file.stamp_ = stamp_of(facts);
  file.has_path_ = true;
  return file;
}

RandomFile RandomFile::of_bytes(std::string_view bytes, const std::string& name) {
  RandomFile file;
  file.path_ = name;
  file.bytes_ = bytes;
  file.size_ = static_cast<std::int64_t>(bytes.size());
  return file;
}

RandomFile RandomFile::of_descriptor(Descriptor file, const std::string& name) {
  RandomFile made;
  made.path_ = name;
  made.file_ = std::move(file);
  struct stat facts = {};
  if (fstat(made.file_.get(), &facts) == 0) {
    made.size_ = facts.st_size;
    made.stamp_ = stamp_of(facts);
  }
  return made;
}

RandomFile RandomFile::of_owned(std::string bytes, const std::string& name) {
  auto owned = std::make_unique<const std::string>(std::move(bytes));
  RandomFile file = of_bytes(*owned, name);
  file.owned_ = std::move(owned);
  return file;
}

bool RandomFile::changed() const {
  struct stat facts = {};
  if (!file_ || fstat(file_.get(), &facts) != 0) return false;
  const FileStamp now = stamp_of(facts);
  return facts.st_size < size_ ||
         (facts.st_size == size_ && (now.written_s != stamp_.written_s || now.written_ns != stamp_.written_ns));
}

Descriptor RandomFile::another_descriptor() const {
  return Descriptor(file_ ? fcntl(file_.get(), F_DUPFD_CLOEXEC, 0) : -1);
}

Result<std::string> RandomFile::read(std::int64_t place, std::int64_t count) const {
  if (Status status = check_range(place, count); !status) return status.error();
  try {
    std::string bytes(static_cast<std::size_t>(count), '\0');
    if (Status status = read_into(place, count, bytes.data()); !status) return status.error();
    return bytes;
  } catch (const std::bad_alloc&) {
    return Error{no_memory_for("reading it").message, path_, 0, 0, ""};
  }
}

Status RandomFile::check_range(std::int64_t place, std::int64_t count) const {
  if (place < 0 || count < 0 || place > size_ || count > size_ - place) return ends_early();
  return Done{};
}

Error RandomFile::ends_early() const {
  return {"the file ends too early", path_, 0, 0, "it may be cut"};
}

Status RandomFile::read_into(std::int64_t place, std::int64_t count, char* to) const {
  if (Status status = check_range(place, count); !status) return status;
  const auto wanted = static_cast<std::size_t>(count);
  if (!file_) {
    bytes_.copy(to, wanted, static_cast<std::size_t>(place));
    return Done{};
  }
  for (std::size_t have = 0; have < wanted;) {
    stop_if_cancelled();
    const ssize_t n =
        pread(file_.get(), to + have, std::min(wanted - have, kMostAtOnce), place + static_cast<off_t>(have));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return unreadable(path_, errno);
    if (n == 0) return ends_early();
    have += static_cast<std::size_t>(n);
  }
  return Done{};
}

}  // namespace bihive
