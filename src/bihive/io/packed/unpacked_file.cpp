#include "bihive/io/packed/unpacked_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/write_file.h"
#include "bihive/io/packed.h"
#include "bihive/io/packed/unpack.h"

namespace bihive {
namespace {

constexpr std::int64_t kPieceBytes = std::int64_t{1} << 18;
constexpr std::size_t kHeadOfFile = 65536;

// Unpacked bytes stay in memory up to this size, so that small files need no disk.
constexpr double kMostInMemory = 1 << 25;
constexpr double kMostOfMemory = 0.25;

#ifdef __EMSCRIPTEN__
constexpr bool kHasDisk = false;  // its files lie in memory anyway
#else
constexpr bool kHasDisk = true;
#endif

PieceSource pieces_of(const RandomFile& file, std::string& piece) {
  return [&file, &piece, place = std::int64_t{0}]() mutable -> Result<std::string_view> {
    Result<std::string> read = file.read(place, std::min(kPieceBytes, file.size() - place));
    if (!read) return read.error();
    piece = std::move(*read);
    place += static_cast<std::int64_t>(piece.size());
    return std::string_view(piece);
  };
}

// Bytes that grow: in memory, then in a file without a name, which the system removes when it is closed.
class GrowingBytes {
 public:
  explicit GrowingBytes(std::string name) : name_(std::move(name)) {}

  Status append(std::string_view piece) {
    if (!file_ && static_cast<double>(kept_.size() + piece.size()) > most_in_memory_)
      if (Status status = go_to_disk(); !status) return status;
    if (file_) return write_all(piece);
    kept_ += piece;
    return Done{};
  }

  Result<RandomFile> finish() {
    if (!file_) return RandomFile::of_owned(std::move(kept_), name_);
    return RandomFile::of_descriptor(std::move(file_), name_);
  }

 private:
  Error no_room(const std::string& why) const {
    return {"it is packed, and there is no room to unpack it in " + folder_ + ": " + why, name_, 0, 0,
            "name another folder in TMPDIR, or unpack the file first"};
  }

  Status go_to_disk() {
    // /tmp is memory on many systems, /var/tmp is not.
    const char* const chosen = std::getenv("TMPDIR");
    folder_ = chosen != nullptr && *chosen != '\0' ? chosen : access("/var/tmp", W_OK) == 0 ? "/var/tmp" : "/tmp";
    std::string path = folder_ + "/bihive-XXXXXX";
    file_ = Descriptor(mkstemp(path.data()));
    if (!file_) return no_room(std::strerror(errno));
    unlink(path.c_str());
    fcntl(file_.get(), F_SETFD, FD_CLOEXEC);
    const std::string kept = std::exchange(kept_, std::string());
    return write_all(kept);
  }

  // The disk keeps a part of its room for other programs.
  Status check_room() const {
    constexpr double kLeastShare = 0.05;
    struct statvfs facts = {};
    if (fstatvfs(file_.get(), &facts) != 0 || facts.f_blocks == 0) return Done{};
    if (static_cast<double>(facts.f_bavail) >= kLeastShare * static_cast<double>(facts.f_blocks)) return Done{};
    return no_room("less than a twentieth of the disk would be left");
  }

  Status write_all(std::string_view piece) {
    constexpr std::int64_t kCheckEvery = std::int64_t{1} << 26;
    if (written_ / kCheckEvery != (written_ + static_cast<std::int64_t>(piece.size())) / kCheckEvery)
      if (Status status = check_room(); !status) return status;
    if (const int code = write_whole(file_.get(), piece); code != 0) return no_room(std::strerror(code));
    written_ += static_cast<std::int64_t>(piece.size());
    return Done{};
  }

  std::string name_, kept_, folder_;
  const double most_in_memory_ = std::min(kMostInMemory, kMostOfMemory* memory_bytes());
  Descriptor file_;
  std::int64_t written_ = 0;
};

// A pipe must not be opened twice.
bool is_plain(const std::string& path) {
  struct stat facts = {};
  return stat(path.c_str(), &facts) == 0 && S_ISREG(facts.st_mode) && facts.st_size > 0;
}

Result<RandomFile> unpacked(const RandomFile& file, Packing packing) {
  std::string piece;
  GrowingBytes bytes(file.path());
  const auto sink = [&bytes](std::string_view some) -> Result<bool> {
    if (Status status = bytes.append(some); !status) return status.error();
    return true;
  };
  if (Status status = unpack_pieces(packing, pieces_of(file, piece), file.path(), sink); !status) return status.error();
  return bytes.finish();
}

Result<RandomFile> in_memory(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  if (packing_of(*bytes) != Packing::none) bytes = unpack_bytes(*bytes, path);
  if (!bytes) return bytes.error();
  return RandomFile::of_owned(std::move(*bytes), path);
}

}  // namespace

Result<RandomFile> open_unpacked(const std::string& path) {
  if (!is_plain(path)) return in_memory(path);
  Result<RandomFile> file = RandomFile::open(path);
  if (!file) return in_memory(path);
  const Result<std::string> mark = file->read(0, std::min<std::int64_t>(kPackingMarkBytes, file->size()));
  if (!mark) return mark.error();
  const Packing packing = packing_of(*mark);
  if (packing == Packing::none) return file;
  return kHasDisk ? unpacked(*file, packing) : in_memory(path);
}

Result<std::string> read_head(const std::string& path) try {
  if (!is_plain(path)) return read_file(path);
  const Result<RandomFile> file = RandomFile::open(path);
  if (!file) return read_file(path);
  Result<std::string> head = file->read(0, std::min(static_cast<std::int64_t>(kHeadOfFile), file->size()));
  if (!head || packing_of(*head) == Packing::none) return head;
  std::string piece, begin;
  const auto sink = [&begin](std::string_view some) -> Result<bool> {
    begin += some;
    return begin.size() < kHeadOfFile;
  };
  if (Status status = unpack_pieces(packing_of(*head), pieces_of(*file, piece), path, sink); !status)
    return status.error();
  begin.resize(std::min(begin.size(), kHeadOfFile));
  return begin;
} catch (const std::bad_alloc&) {
  return Error{no_memory_for("reading it").message, path, 0, 0, ""};
}

}  // namespace bihive
