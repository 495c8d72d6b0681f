#include "bihive/base/write_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <utility>

#include "bihive/base/aside_file.h"
#include "bihive/base/open_file.h"
#include "bihive/base/output_place.h"

namespace bihive {
namespace {

#if defined(O_PATH)
constexpr int kOpenFolder = O_PATH | O_DIRECTORY | O_CLOEXEC;
#else
constexpr int kOpenFolder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
#endif

constexpr int kAttempts = 100;
constexpr mode_t kOwnerOnly = 0600;
constexpr mode_t kForAll = 0666;  // less the file mode creation mask

// The file is closed, whatever the result: 0 or an errno.
int close_file(int file) {
  return ::close(file) == 0 || errno == EINTR ? 0 : errno;
}

// Some file systems (FUSE, NFS) report lost bytes only when a descriptor is closed. The file itself stays open, and
// with it the lock.
int close_copy(int file) {
  const int copy = ::fcntl(file, F_DUPFD_CLOEXEC, 3);
  return copy < 0 ? 0 : close_file(copy);
}

// Swaps two names in one step, where the file system can.
bool exchange_names(int folder, const std::string& a, const std::string& b) {
#if defined(__GLIBC__) && defined(RENAME_EXCHANGE)
  return ::renameat2(folder, a.c_str(), folder, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  (void)folder;
  return a == b;
#endif
}

}  // namespace

GrowingFile::GrowingFile() = default;

Status GrowingFile::open_aside(const std::string& folder) {
  folder_ = ::open(folder.c_str(), kOpenFolder);
  if (folder_ < 0) return system_error("cannot be created", given_path_, errno);
  folder_aside_ = folder;
  const bool replaces = place_->kind == OutputPlace::Kind::replaced;
  remove_left_parts(folder_, replaces ? place_->user : geteuid());
  // The system gives a new file its permissions here: umask() would clear the mask for other threads for a moment. A
  // file that replaces another gets that one's permissions when it is complete.
  const mode_t mode = place_->kind == OutputPlace::Kind::fresh ? kForAll : kOwnerOnly;
  file_ = open_nameless(folder_, mode);
  if (file_ < 0) file_ = open_under_random_name(folder_, mode, aside_);
  if (file_ < 0) return system_error("cannot be created", given_path_, errno);
  return Done{};
}

Result<GrowingFile> GrowingFile::begin(const std::string& given_path) {
  Result<OutputPlace> place = find_output(given_path);
  if (!place) return place.error();
  GrowingFile growing;
  growing.given_path_ = given_path;
  growing.place_ = std::make_unique<OutputPlace>(std::move(*place));
  const OutputPlace& target = *growing.place_;
  if (target.kind == OutputPlace::Kind::descriptor) {
    growing.file_ = ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 3);
    if (growing.file_ < 0) return system_error("cannot be written", given_path, errno);
    return growing;
  }
  if (target.kind == OutputPlace::Kind::stream) {
    growing.file_ = ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (growing.file_ < 0) return system_error("cannot be written", given_path, errno);
    return growing;
  }
  if (Status status = growing.open_aside(target.folder); !status) return status.error();
  return growing;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      folder_(std::exchange(other.folder_, -1)),
      old_file_(std::exchange(other.old_file_, -1)),
      size_(other.size_),
      given_path_(std::move(other.given_path_)),
      place_(std::move(other.place_)),
      folder_aside_(std::move(other.folder_aside_)),
      aside_(std::exchange(other.aside_, std::string())),
      old_(std::exchange(other.old_, std::string())),
      spare_name_(std::move(other.spare_name_)),
      kept_name_(std::move(other.kept_name_)),
      new_name_(std::move(other.new_name_)),
      link_from_(std::move(other.link_from_)),
      placed_(other.placed_) {}

GrowingFile::~GrowingFile() {
  if (file_ >= 0) ::close(file_);
  if (old_file_ >= 0) ::close(old_file_);
  if (!aside_.empty()) ::unlinkat(folder_, aside_.c_str(), 0);
  if (folder_ >= 0) ::close(folder_);
}

bool GrowingFile::can_go_back() const {
  return place_ != nullptr && place_->regular();
}

std::string GrowingFile::path_aside() const {
  return aside_.empty() ? "" : folder_aside_ + "/" + aside_;
}

Status GrowingFile::failed(int code) const {
  return system_error("writing failed", given_path_, code,
                      code == ENOSPC && can_go_back() ? "free some space or write elsewhere" : "");
}

Status GrowingFile::append(std::string_view bytes) {
  if (const int code = write_whole(file_, bytes); code != 0) return failed(code);
  size_ += bytes.size();
  return Done{};
}

Status GrowingFile::write_at(std::uint64_t place, std::string_view bytes) {
  if (place == size_) return append(bytes);
  if (!can_go_back()) return failed(ESPIPE);
  if (::lseek(file_, static_cast<off_t>(place), SEEK_SET) < 0) return failed(errno);
  if (const int code = write_whole(file_, bytes); code != 0) return failed(code);
  size_ = std::max(size_, place + bytes.size());
  if (::lseek(file_, static_cast<off_t>(size_), SEEK_SET) < 0) return failed(errno);
  return Done{};
}

// All strings that the later steps need, because nothing is allocated from then on: a program that runs out of memory
// may end there, and would leave a partial file.
void GrowingFile::choose_names() {
  spare_name_ = random_part_name();
  kept_name_ = random_kept_name();
  new_name_ = random_part_name();
  link_from_ = path_of_descriptor(file_);
}

// A file without a name gets one. 0 or an errno.
int GrowingFile::name_aside() {
  for (int attempt = 0; aside_.empty() && attempt < kAttempts; ++attempt) {
    if (::linkat(AT_FDCWD, link_from_.c_str(), folder_, new_name_.c_str(), AT_SYMLINK_FOLLOW) == 0)
      aside_.swap(new_name_);
    else if (errno != EEXIST)
      return errno;
    else
      new_name_ = random_part_name();
  }
  return aside_.empty() ? EEXIST : 0;
}

// The file gets the owner and permissions of the one before, and reaches the disk. It stays open, because its lock
// shows that the program is alive. 0 or an errno.
int GrowingFile::settle() {
  if (!can_go_back()) return close_file(std::exchange(file_, -1));
  if (place_->kind == OutputPlace::Kind::in_place) return 0;

  // Some file systems (vfat, CIFS) have neither owners nor permissions. The file is just as good without them.
  if (place_->kind == OutputPlace::Kind::replaced) {
    mode_t mode = place_->mode;
    struct stat info {};
    if (::fstat(file_, &info) == 0 && (info.st_uid != place_->user || info.st_gid != place_->group) &&
        ::fchown(file_, place_->user, place_->group) != 0) {
      // A group other than before gets no more rights than everybody.
      mode &= ~static_cast<mode_t>(S_IRWXG) | (mode & S_IRWXO) << 3;
    }
    (void)::fchmod(file_, mode);
  }

  if (const int code = flush_to_disk(file_); code != 0) return code;
  return close_copy(file_);
}

// Over the bytes of a mount point.
int GrowingFile::copy_in_place() {
  const int target = ::open(place_->path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (target < 0) return errno;
  int code = ::lseek(file_, 0, SEEK_SET) < 0 ? errno : 0;
  char buffer[1 << 16];
  while (code == 0) {
    const ssize_t count = ::read(file_, buffer, sizeof(buffer));
    if (count == 0) break;
    if (count > 0)
      code = write_whole(target, {buffer, static_cast<std::size_t>(count)});
    else if (errno != EINTR)
      code = errno;
  }
  if (code == 0 && ::ftruncate(target, static_cast<off_t>(size_)) != 0) code = errno;
  if (code == 0) code = flush_to_disk(target);
  const int closed = close_file(target);
  return code != 0 ? code : closed;
}

// Keeps the previous file under another name, so that undo() can restore it. 0 or an errno. With `exchanged` the new
// file already has its name.
int GrowingFile::put_old_aside(bool& exchanged) {
  const std::string& name = place_->name;
  // The lock says that this program is alive: see remove_left_parts().
  old_file_ = ::openat(folder_, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (old_file_ >= 0) (void)::flock(old_file_, LOCK_SH | LOCK_NB);
  exchanged = exchange_names(folder_, aside_, name);
  if (exchanged)
    old_.swap(aside_);
  else if (::linkat(folder_, name.c_str(), folder_, spare_name_.c_str(), 0) == 0)
    old_.swap(spare_name_);
  // Neither exchanges nor links: for a moment nothing has the name.
  else if (::renameat(folder_, name.c_str(), folder_, kept_name_.c_str()) == 0)
    old_.swap(kept_name_);
  else
    return errno;
  return 0;
}

// `keep_old`: so that undo() can bring it back. 0 or an errno. Nothing here or in undo() allocates memory, because a
// program may end when there is none.
int GrowingFile::take_place(bool keep_old) {
  const std::string& name = place_->name;
  // The usual way of a new file: no other name is ever seen.
  if (aside_.empty() && place_->kind == OutputPlace::Kind::fresh) {
    placed_ = ::linkat(AT_FDCWD, link_from_.c_str(), folder_, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    if (placed_) return 0;
    if (errno != EEXIST) return errno;
  }
  if (const int code = name_aside(); code != 0) return code;
  bool exchanged = false;
  if (keep_old && place_->kind == OutputPlace::Kind::replaced)
    if (const int code = put_old_aside(exchanged); code != 0) return code;
  if (!exchanged && ::renameat(folder_, aside_.c_str(), folder_, name.c_str()) != 0) return errno;
  aside_.clear();
  placed_ = true;
  return 0;
}

void GrowingFile::undo() {
  // A rename between two names of one file keeps both names.
  if (!old_.empty() && ::renameat(folder_, old_.c_str(), folder_, place_->name.c_str()) == 0)
    remove_old();
  else if (old_.empty() && placed_)
    ::unlinkat(folder_, place_->name.c_str(), 0);
  placed_ = false;
}

void GrowingFile::remove_old() {
  if (!old_.empty()) ::unlinkat(folder_, old_.c_str(), 0);
  old_.clear();
  if (old_file_ >= 0) ::close(std::exchange(old_file_, -1));
}

Status GrowingFile::finish_together(std::vector<GrowingFile>& files) {
  // All bytes reach the disk first.
  for (GrowingFile& file : files) file.choose_names();
  for (GrowingFile& file : files)
    if (const int code = file.settle(); code != 0) return file.failed(code);

  // Replace the files, then write those that must be written in place.
  const bool several = files.size() > 1;
  const auto undo_all = [&files] {
    for (GrowingFile& file : files) file.undo();
  };
  for (GrowingFile& file : files) {
    if (!file.can_go_back() || file.place_->kind == OutputPlace::Kind::in_place) continue;
    if (const int code = file.take_place(several); code != 0) {
      undo_all();
      return file.failed(code);
    }
  }
  for (GrowingFile& file : files) {
    if (file.place_->kind != OutputPlace::Kind::in_place) continue;
    if (const int code = file.copy_in_place(); code != 0) {
      undo_all();
      return system_error("writing failed", file.given_path_, code,
                          "it is a mount point and was written in place, so it may hold a part now");
    }
  }
  for (GrowingFile& file : files) file.remove_old();
  return Done{};
}

Status GrowingFile::finish() {
  std::vector<GrowingFile> one;
  one.push_back(std::move(*this));
  return finish_together(one);
}

Status write_file(const std::string& path, std::string_view bytes) {
  Result<GrowingFile> file = GrowingFile::begin(path);
  if (!file) return file.error();
  if (Status status = file->append(bytes); !status) return status;
  return file->finish();
}

Status check_writable(const std::string& path) {
  const Result<OutputPlace> place = find_output(path);
  if (!place) return place.error();
  if (!place->regular()) return Done{};
  const Result<GrowingFile> file = GrowingFile::begin(path);
  if (!file) return file.error();
  return Done{};
}

bool is_stream(const std::string& path) {
  const Result<OutputPlace> place = find_output(path);
  return place && !place->regular();
}

bool is_standard_output(const std::string& path) {
  const Result<OutputPlace> place = find_output(path);
  if (!place || place->kind != OutputPlace::Kind::descriptor) return false;
  struct stat info {};
  return ::fstat(STDOUT_FILENO, &info) == 0 && info.st_dev == place->device && info.st_ino == place->inode;
}

bool is_same_file(const std::string& a, const std::string& b) {
  const Result<OutputPlace> first = find_output(a);
  if (!first || !first->regular()) return false;
  struct stat info {};
  if (::stat(b.c_str(), &info) == 0)
    return first->kind != OutputPlace::Kind::fresh && info.st_dev == first->device && info.st_ino == first->inode;
  const Result<OutputPlace> second = find_output(b);
  return second && same_place(*first, *second);
}

}  // namespace bihive
