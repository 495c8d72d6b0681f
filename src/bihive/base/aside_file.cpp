#include "bihive/base/aside_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>

#include "bihive/base/open_file.h"

namespace bihive {
namespace {

constexpr std::string_view kPrefix = ".bihive-";
constexpr std::string_view kPart = ".part";
constexpr std::string_view kKept = ".kept";
constexpr std::size_t kDigits = 16;
constexpr int kAttempts = 100;

std::string random_name(std::string_view suffix) {
  return std::string(kPrefix) + random_digits() + std::string(suffix);
}

// Large folders that were read recently: a film of 100,000 pictures must not read its folder once per picture.
class LargeFolders {
 public:
  static constexpr std::int64_t kMany = 1000;

  bool was_just_read(const struct stat& folder) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto entry = find(folder);
    return entry != read_.end() && now_s() - entry->at_s < kPauseS;
  }
  void is_read(const struct stat& folder) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto entry = find(folder);
    if (entry == read_.end())
      entry =
          std::min_element(read_.begin(), read_.end(), [](const Read& a, const Read& b) { return a.at_s < b.at_s; });
    *entry = {folder.st_dev, folder.st_ino, now_s()};
  }

 private:
  static constexpr std::int64_t kPauseS = 60;
  struct Read {
    dev_t device = 0;
    ino_t inode = 0;
    std::int64_t at_s = -kPauseS;
  };
  using Reads = std::array<Read, 8>;

  Reads::iterator find(const struct stat& folder) {
    return std::find_if(read_.begin(), read_.end(),
                        [&](const Read& one) { return one.device == folder.st_dev && one.inode == folder.st_ino; });
  }
  static std::int64_t now_s() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec};
  }

  std::mutex mutex_;
  Reads read_;
};

// The file mode creation mask, read without umask(), which would clear it for all threads for a moment. Unknown before
// Linux 4.7.
std::optional<mode_t> creation_mask() {
  std::FILE* const status = std::fopen("/proc/self/status", "re");
  if (status == nullptr) return std::nullopt;
  std::optional<mode_t> mask;
  char line[256];
  unsigned bits = 0;
  while (!mask && std::fgets(line, sizeof(line), status) != nullptr)
    if (std::sscanf(line, "Umask: %o", &bits) == 1) mask = static_cast<mode_t>(bits);
  std::fclose(status);
  return mask;
}

}  // namespace

std::string random_part_name() {
  return random_name(kPart);
}

std::string random_kept_name() {
  return random_name(kKept);
}

bool is_part_name(std::string_view name) {
  if (name.size() != kPrefix.size() + kDigits + kPart.size() || name.substr(0, kPrefix.size()) != kPrefix ||
      name.substr(kPrefix.size() + kDigits) != kPart)
    return false;
  return name.substr(kPrefix.size(), kDigits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void remove_left_parts(int folder, uid_t also_of) {
  static LargeFolders large;
  struct stat facts {};
  if (::fstat(folder, &facts) != 0 || large.was_just_read(facts)) return;
  const int readable = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (readable < 0) return;
  DIR* const listing = ::fdopendir(readable);
  if (listing == nullptr) {
    ::close(readable);
    return;
  }
  const auto is_own = [also_of](const struct stat& info) {
    return S_ISREG(info.st_mode) && (info.st_uid == geteuid() || info.st_uid == also_of);
  };
  std::int64_t entries = 0;
  while (const dirent* const entry = ::readdir(listing)) {
    ++entries;
    struct stat info {};
    if (!is_part_name(entry->d_name) || ::fstatat(readable, entry->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0 ||
        !is_own(info))
      continue;
    // Locks on network file systems need a writable file, and a part may already have its final permissions.
    constexpr int kHow = O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
    int file = ::openat(readable, entry->d_name, O_RDWR | kHow);
    if (file < 0) file = ::openat(readable, entry->d_name, O_RDONLY | kHow);
    if (file < 0) continue;
    // A program that writes the file, or keeps it for a moment, holds a lock on it.
    if (::fstat(file, &info) == 0 && is_own(info) && ::flock(file, LOCK_EX | LOCK_NB) == 0)
      ::unlinkat(readable, entry->d_name, 0);
    ::close(file);
  }
  ::closedir(listing);
  if (entries > LargeFolders::kMany) large.is_read(facts);
}

std::string path_of_descriptor(int file) {
  return "/proc/self/fd/" + std::to_string(file);
}

int open_nameless(int folder, mode_t mode) {
#if defined(O_TMPFILE)
  const int file = ::openat(folder, ".", O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
  if (file < 0) return -1;
  if (::access(path_of_descriptor(file).c_str(), F_OK) != 0) {
    ::close(file);
    return -1;
  }
  // Linux before 5.19 forgets the mask here where the file system has no access control lists.
  struct stat info {};
  if (mode != (mode & 0700) && ::fstat(file, &info) == 0 && (info.st_mode & 0777) == mode)
    if (const std::optional<mode_t> mask = creation_mask(); mask && (mode & *mask) != 0)
      (void)::fchmod(file, mode & ~*mask);
  // It may get a name before it takes its path: see remove_left_parts().
  (void)::flock(file, LOCK_EX | LOCK_NB);
  return file;
#else
  (void)folder;
  (void)mode;
  return -1;
#endif
}

int open_under_random_name(int folder, mode_t mode, std::string& name) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    name = random_part_name();
    const int file = ::openat(folder, name.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_RDWR | O_CLOEXEC, mode);
    if (file < 0) {
      if (errno != EEXIST && errno != EINTR) break;
      continue;
    }
    // Not every file system has locks; each is asked only once. A program that checked between the two calls took the
    // file for an abandoned one.
    const bool taken = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    struct stat info {};
    if (!taken && (::fstat(file, &info) != 0 || info.st_nlink > 0)) return file;
    ::close(file);
    if (taken) ::unlinkat(folder, name.c_str(), 0);
    errno = EEXIST;
  }
  name.clear();
  return -1;
}

}  // namespace bihive
