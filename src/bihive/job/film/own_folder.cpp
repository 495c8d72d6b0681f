#include "bihive/job/film/own_folder.h"

#include <dirent.h>
#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <ctime>

#include "bihive/base/path_parts.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"

namespace bihive {
namespace {

constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;
constexpr mode_t kOwnerOnly = 0600;
constexpr int kOpenFolder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

[[noreturn]] void refuse(const std::string& what, const std::string& path, const std::string& hint) {
  fail({what, path, 0, 0, hint});
}

// The owner and mode of a new file here: a file system without users gives all files to one user, and one without
// permissions invents them.
std::optional<struct stat> facts_of_new_file(int folder) {
  const std::string name = random_part_name();
  const Descriptor file(openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerOnly));
  if (!file) return std::nullopt;
  struct stat info {};
  const bool known = fstat(file.get(), &info) == 0;
  unlinkat(folder, name.c_str(), 0);
  if (!known) return std::nullopt;
  return info;
}

}  // namespace

bool OwnFolder::is_ours(const struct stat& info) const {
  if (info.st_uid == geteuid()) return true;
  const std::optional<struct stat> made = facts_of_new_file(folder_.get());
  return made && made->st_uid == info.st_uid;
}

void OwnFolder::check_is_private() const {
  struct stat info {};
  if (fstat(folder_.get(), &info) != 0) fail_of_system("cannot be read", path_, errno);
  if (!is_ours(info))
    refuse("belongs to another user", path_,
           "remove it, or name another output; all shards of a film must be made by one user");
  if ((info.st_mode & kOthersWrite) == 0) return;
  const std::optional<struct stat> made = facts_of_new_file(folder_.get());
  if (made && (made->st_mode & kOthersWrite) != 0) return;  // a file system without permissions
  refuse("can be written to by other users", path_, "remove it, or, if you trust its contents: chmod go-w");
}

std::optional<OwnFolder> OwnFolder::open_private(const std::string& path) {
  Descriptor folder(::open(path.c_str(), kOpenFolder | O_NOFOLLOW));
  if (!folder) {
    const int code = errno;
    struct stat info {};
    if (lstat(path.c_str(), &info) != 0 && errno == ENOENT) return std::nullopt;
    if (code == ELOOP || code == ENOTDIR)
      refuse(S_ISLNK(info.st_mode) ? "is a symbolic link where the folder for the film's parts would be"
                                   : "is not a folder, and is in the place where the film would be made",
             path, "remove it, or name another output");
    fail_of_system("cannot be read", path, code);
  }
  OwnFolder opened(std::move(folder), path);
  opened.check_is_private();
  opened.is_private_ = true;
  return opened;
}

std::optional<OwnFolder> OwnFolder::open_shared(const std::string& path) {
  struct stat link {};
  if (lstat(path.c_str(), &link) != 0) {
    if (errno == ENOENT) return std::nullopt;
    fail_of_system("cannot be read", path, errno);
  }
  struct stat around {};
  if (S_ISLNK(link.st_mode) && link.st_uid != geteuid() &&
      (stat(folder_of(path).c_str(), &around) != 0 || link.st_uid != around.st_uid))
    refuse("is a symbolic link that belongs to another user", path, "write to another folder");
  Descriptor folder(::open(path.c_str(), kOpenFolder));
  if (!folder) fail_of_system("cannot be read", path, errno);
  return OwnFolder(std::move(folder), path);
}

std::vector<std::string> OwnFolder::names() const {
  std::vector<std::string> found;
  const int again = openat(folder_.get(), ".", kOpenFolder);
  DIR* const listing = again < 0 ? nullptr : fdopendir(again);
  if (listing == nullptr) {
    const int code = errno;
    if (again >= 0) close(again);
    fail_of_system("cannot be read", path_, code);
  }
  while (const dirent* const entry = readdir(listing))
    if (const std::string name = entry->d_name; name != "." && name != "..") found.push_back(name);
  closedir(listing);
  return found;
}

bool OwnFolder::has(const std::string& name) const {
  struct stat info {};
  return fstatat(folder_.get(), name.c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0;
}

std::optional<Descriptor> OwnFolder::open_file(const std::string& name, int flags) const {
  Descriptor file(openat(folder_.get(), name.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kOwnerOnly));
  if (!file && errno == ENOENT) return std::nullopt;
  if (!file && errno == ELOOP) refuse("is a symbolic link", path_of(name), "remove it");
  struct stat info {};
  if (!file || fstat(file.get(), &info) != 0) fail_of_system("cannot be opened", path_of(name), errno);
  if (!S_ISREG(info.st_mode)) refuse("is not a regular file", path_of(name), "remove it");
  if (!is_ours(info))
    refuse("belongs to another user", path_of(name),
           "remove it, or name another output; all shards of a film must be made by one user");
  if (info.st_nlink > 1) refuse("has several hard links", path_of(name), "remove it");
  if (!is_private_ && (info.st_mode & kOthersWrite) != 0) {
    const std::optional<struct stat> made = facts_of_new_file(folder_.get());
    if (!made || (made->st_mode & kOthersWrite) == 0)
      refuse("can be written to by other users", path_of(name), "remove it, or, if you trust its contents: chmod go-w");
  }
  return file;
}

std::optional<std::string> OwnFolder::read(const std::string& name) const {
  const std::optional<Descriptor> file = open_file(name, O_RDONLY);
  if (!file) return std::nullopt;
  return value_or_fail(read_descriptor(file->get(), path_of(name)));
}

std::optional<Descriptor> OwnFolder::open_picture(const std::string& name) const {
  Descriptor file(openat(folder_.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (!file || fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode) || !is_ours(info)) return std::nullopt;
  return file;
}

bool OwnFolder::write_new(const std::string& name, std::string_view bytes, mode_t mode) const {
  const Descriptor file(
      openat(folder_.get(), name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
  if (!file && errno == EEXIST) return false;
  if (!file) fail_of_system("cannot be written", path_of(name), errno);
  int code = write_whole(file.get(), bytes);
  if (code == 0) code = flush_to_disk(file.get());
  if (code == 0) return true;
  remove(name);
  fail_of_system("writing failed", path_of(name), code);
}

bool OwnFolder::place_new(const std::string& name, std::string_view bytes, mode_t mode) const {
#if defined(O_TMPFILE)
  // A file without a name leaves nothing, even after SIGKILL.
  if (const Descriptor file(openat(folder_.get(), ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, mode)); file) {
    int code = write_whole(file.get(), bytes);
    if (code == 0) code = flush_to_disk(file.get());
    if (code != 0) fail_of_system("writing failed", path_of(name), code);
    const std::string link = "/proc/self/fd/" + std::to_string(file.get());
    if (linkat(AT_FDCWD, link.c_str(), folder_.get(), name.c_str(), AT_SYMLINK_FOLLOW) == 0) return true;
    if (errno == EEXIST) return false;
  }
#endif
  const std::string aside = random_part_name();
  write_new(aside, bytes, mode);
  int code = 0;
  if (linkat(folder_.get(), aside.c_str(), folder_.get(), name.c_str(), 0) != 0) code = errno;
  const bool without_links = code == EPERM || code == ENOTSUP || code == ENOSYS;
  if (without_links) {
    struct stat info {};
    code = fstatat(folder_.get(), name.c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0 ? EEXIST : 0;
    if (code == 0 && renameat(folder_.get(), aside.c_str(), folder_.get(), name.c_str()) == 0) return true;
    if (code == 0) code = errno;
  }
  remove(aside);
  if (code != 0 && code != EEXIST) fail_of_system("cannot be written", path_of(name), code);
  return code == 0;
}

void OwnFolder::rename(const std::string& from, const std::string& to) const {
  if (renameat(folder_.get(), from.c_str(), folder_.get(), to.c_str()) != 0)
    fail_of_system("cannot be written", path_of(to), errno);
}

void OwnFolder::remove(const std::string& name) const {
  unlinkat(folder_.get(), name.c_str(), 0);
}

}  // namespace bihive
