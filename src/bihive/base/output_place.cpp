#include "bihive/base/output_place.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>

#include "bihive/base/ascii.h"
#include "bihive/base/path_parts.h"

namespace bihive {
namespace {

// As many links as Linux follows.
constexpr int kMostLinks = 40;

std::optional<int> small_number(std::string_view digits) {
  if (digits.empty() || digits.size() > 6) return std::nullopt;
  int number = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return std::nullopt;
    number = 10 * number + (c - '0');
  }
  return number;
}

// The descriptor that a path names: a file that this program has open. Opening it again would lose its offset and
// truncate it.
std::optional<int> descriptor_of(const std::string& path) {
  if (path == "/dev/stdin") return STDIN_FILENO;
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  const std::string folder = folder_of(path);
  bool of_this_program = folder == "/dev/fd" || folder == "/proc/self/fd";
  if (!of_this_program) {
    char resolved[PATH_MAX];
    of_this_program =
        realpath(folder.c_str(), resolved) != nullptr && resolved == "/proc/" + std::to_string(getpid()) + "/fd";
  }
  return of_this_program ? small_number(name_in_folder(path)) : std::nullopt;
}

// Attributes of a file beyond its permissions; none if the system does not report them.
struct Marks {
  bool mount_point = false, append_only = false, immutable = false;
};

Marks marks_of(const std::string& path) {
  Marks marks;
#if defined(__linux__) && defined(STATX_ATTR_MOUNT_ROOT)
  struct statx facts {};
  if (::statx(AT_FDCWD, path.c_str(), 0, STATX_BASIC_STATS, &facts) == 0) {
    marks.mount_point = (facts.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
    marks.append_only = (facts.stx_attributes & STATX_ATTR_APPEND) != 0;
    marks.immutable = (facts.stx_attributes & STATX_ATTR_IMMUTABLE) != 0;
  }
#else
  (void)path;
#endif
  return marks;
}

bool is_super_user() {
  return geteuid() == 0;
}

// Whether only its owner, and the folder's, may remove a file from the folder.
bool keeps_foreign_files(const struct stat& folder) {
  return (folder.st_mode & S_ISVTX) != 0 && folder.st_uid != geteuid() && !is_super_user();
}

// In a folder where everybody may make links, somebody else's link may lead anywhere.
bool is_foreign_link(const struct stat& link, const struct stat& folder) {
  return (folder.st_mode & S_IWOTH) != 0 && link.st_uid != geteuid() && link.st_uid != folder.st_uid;
}

// The folder must be there. check_replacement() checks whether it is writable.
Status check_folder(const std::string& folder, const std::string& given, struct stat& info) {
  if (::stat(folder.c_str(), &info) != 0)
    return system_error("the folder " + folder + " cannot be used", given, errno, "make the folder first");
  if (!S_ISDIR(info.st_mode)) return Error{folder + " is not a folder", given, 0, 0, ""};
  return Done{};
}

// A regular file, or none, at place.path: can another file replace it?
Status check_replacement(const std::string& given, const struct stat& folder, OutputPlace& place) {
  if (::access(place.folder.c_str(), W_OK | X_OK) != 0)
    return system_error("the folder " + place.folder + " cannot be written to", given, errno);
  if (marks_of(place.folder).append_only)
    return Error{"nothing can be replaced in the folder " + place.folder + ", because it is append-only", given, 0, 0,
                 "write elsewhere"};
  if (place.kind == OutputPlace::Kind::fresh) return Done{};
  const Marks marks = marks_of(place.path);
  if (marks.immutable || marks.append_only)
    return Error{std::string("cannot be replaced, because it is ") + (marks.immutable ? "immutable" : "append-only"),
                 given, 0, 0, "write elsewhere"};
  if (marks.mount_point) {
    place.kind = OutputPlace::Kind::in_place;
    return Done{};
  }
  if (place.user == geteuid() || is_super_user()) return Done{};
  if (keeps_foreign_files(folder))
    return Error{"cannot be replaced, because it belongs to somebody else and its folder is sticky", given, 0, 0,
                 "write elsewhere"};
  return Error{"belongs to somebody else, and would be yours if it were replaced", given, 0, 0,
               "remove it first, or write elsewhere"};
}

Result<OutputPlace> open_descriptor(const std::string& given, int descriptor) {
  OutputPlace place;
  place.kind = OutputPlace::Kind::descriptor;
  place.path = given;
  place.descriptor = descriptor;
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0) return system_error("cannot be written", given, errno);
  if ((flags & O_ACCMODE) == O_RDONLY) return system_error("cannot be written", given, EBADF);
  struct stat info {};
  if (::fstat(descriptor, &info) != 0) return system_error("cannot be written", given, errno);
  place.device = info.st_dev;
  place.inode = info.st_ino;
  return place;
}

}  // namespace

Error system_error(const std::string& what, const std::string& path, int code, const std::string& hint) {
  return {what + ": " + std::strerror(code), path, 0, 0, hint, code};
}

Result<OutputPlace> find_output(const std::string& given) {
  if (given.empty()) return Error{"the output path is empty", "", 0, 0, "name a file"};
  OutputPlace place;
  place.path = given;

  // Follow the links, one by one.
  struct stat info {};
  struct stat folder {};
  bool exists = false;
  for (int links = 0;; ++links) {
    if (const std::optional<int> descriptor = descriptor_of(place.path)) return open_descriptor(given, *descriptor);
    place.folder = folder_of(place.path);
    place.name = name_in_folder(place.path);
    exists = ::lstat(place.path.c_str(), &info) == 0;
    if (!exists && errno != ENOENT && errno != ENOTDIR) return system_error("cannot be written", given, errno);
    if (Status status = check_folder(place.folder, given, folder); !status) return status.error();
    if (!exists || !S_ISLNK(info.st_mode)) break;
    if (is_foreign_link(info, folder))
      return Error{"is a link that somebody else made in a folder of everybody", given, 0, 0,
                   "write to another folder"};
    if (links == kMostLinks) return system_error("cannot be written", given, ELOOP);
    char target[PATH_MAX];
    const ssize_t length = ::readlink(place.path.c_str(), target, sizeof(target));
    if (length < 0) return system_error("cannot be written", given, errno);
    const std::string text(target, static_cast<std::size_t>(length));
    place.path = text.rfind('/', 0) == 0 || place.folder == "." ? text : place.folder + "/" + text;
  }

  // Examine what is there.
  if (exists) {
    if (S_ISDIR(info.st_mode)) return Error{"is a folder", given, 0, 0, "name a file in it", EISDIR};
    if (::access(place.path.c_str(), W_OK) != 0) return system_error("cannot be written", given, errno);
    place.mode = info.st_mode & 0777;
    place.user = info.st_uid;
    place.group = info.st_gid;
    place.device = info.st_dev;
    place.inode = info.st_ino;
    place.kind = S_ISREG(info.st_mode) ? OutputPlace::Kind::replaced : OutputPlace::Kind::stream;
    if (place.kind == OutputPlace::Kind::stream) return place;
  } else if (place.name.empty()) {
    return Error{"is a folder", given, 0, 0, "name a file in it", EISDIR};
  }
  if (Status status = check_replacement(given, folder, place); !status) return status.error();
  return place;
}

bool same_place(const OutputPlace& a, const OutputPlace& b) {
  if (a.kind != OutputPlace::Kind::fresh || b.kind != OutputPlace::Kind::fresh)
    return a.kind != OutputPlace::Kind::fresh && b.kind != OutputPlace::Kind::fresh && a.device == b.device &&
           a.inode == b.inode;
  struct stat folder_a {};
  struct stat folder_b {};
  return a.name == b.name && ::stat(a.folder.c_str(), &folder_a) == 0 && ::stat(b.folder.c_str(), &folder_b) == 0 &&
         folder_a.st_dev == folder_b.st_dev && folder_a.st_ino == folder_b.st_ino;
}

}  // namespace bihive
