#include "bihive/job/film/hidden_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <utility>

#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"

namespace bihive {
namespace {

#if defined(O_PATH)
constexpr int kOpenParent = O_PATH | O_DIRECTORY | O_CLOEXEC;
#else
constexpr int kOpenParent = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
#endif

constexpr std::string_view kHiddenBegin = ".bihive-", kHiddenEnd = ".film";
constexpr std::size_t kHiddenDigits = 16;
constexpr int kAttempts = 20;
constexpr mode_t kFolderOfOwner = 0700;

bool is_hidden_name(std::string_view name) {
  return name.size() == kHiddenBegin.size() + kHiddenDigits + kHiddenEnd.size() && name.starts_with(kHiddenBegin) &&
         name.ends_with(kHiddenEnd);
}

// Older versions used the first two of these.
bool is_own_name(const std::string& name) {
  for (const char* const own : {"ffmpeg.log", "segments.txt", kLockOfFilm})
    if (name == own) return true;
  for (const char* const with : {"film.", "segment-", "unfinished", "picture-", ".bihive-"})
    if (name.starts_with(with)) return true;
  return false;
}

}  // namespace

Descriptor open_parent(const std::string& path) {
  Descriptor parent(open(path.c_str(), kOpenParent));
  if (!parent) fail_of_system("cannot be read", path, errno);
  return parent;
}

std::string hidden_name() {
  return std::string(kHiddenBegin) + random_digits() + std::string(kHiddenEnd);
}

HiddenFolder make_hidden_folder(int parent, const std::string& path_of_parent, int kind) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::string name = hidden_name();
    if (mkdirat(parent, name.c_str(), kFolderOfOwner) != 0) {
      if (errno == EEXIST) continue;
      fail_of_system("a folder for the film cannot be made", path_of_parent, errno);
    }
    try {
      // Before it is locked, another run may take it for that of a killed one.
      std::optional<OwnFolder> folder = OwnFolder::open_private(path_of_parent + "/" + name);
      if (!folder) continue;
      std::optional<Descriptor> lock = lock_folder(*folder, kind);
      // That run may have ended since, and this is the lock of a folder that it has removed.
      if (!lock || !folder->has(kLockOfFilm)) continue;
      return {name, std::move(*folder), std::move(*lock)};
    } catch (const Failure&) {
      unlinkat(parent, name.c_str(), AT_REMOVEDIR);
      throw;
    }
  }
  fail({"a folder for the film cannot be made", path_of_parent, 0, 0, "name another output"});
}

std::optional<Descriptor> lock_folder(const OwnFolder& folder, int kind) {
  std::optional<Descriptor> file = folder.open_file(kLockOfFilm, O_RDWR | O_CREAT);
  if (!file) return std::nullopt;  // the folder has been removed
  if (flock(file->get(), kind | LOCK_NB) != 0 && errno == EWOULDBLOCK) return std::nullopt;
  return file;
}

bool all_own(const OwnFolder& folder) {
  const std::vector<std::string> names = folder.names();
  return std::all_of(names.begin(), names.end(), is_own_name);
}

void remove_own_files(const OwnFolder& folder, std::vector<std::string> known) {
  try {
    known = folder.names();
  } catch (const Failure&) {
    // Too many files are open, say.
  }
  for (const std::string& name : known)
    if (is_own_name(name) && name != kLockOfFilm) folder.remove(name);
  folder.remove(kLockOfFilm);
}

void remove_leftovers(int parent, const std::string& path_of_parent) {
  std::vector<std::string> names;
  try {
    if (const std::optional<OwnFolder> around = OwnFolder::open_shared(path_of_parent)) names = around->names();
  } catch (const Failure&) {
    // A folder that cannot be listed.
  }
  for (const std::string& name : names) {
    if (!is_hidden_name(name)) continue;
    try {
      const std::optional<OwnFolder> rest = OwnFolder::open_private(path_of_parent + "/" + name);
      if (!rest || !all_own(*rest)) continue;
      const std::optional<Descriptor> lock = lock_folder(*rest, LOCK_EX);
      if (!lock) continue;
      remove_own_files(*rest);
      unlinkat(parent, name.c_str(), AT_REMOVEDIR);
    } catch (const Failure&) {
      // It belongs to somebody else, or is no folder.
    }
  }
}

}  // namespace bihive
