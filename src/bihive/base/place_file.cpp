#include "bihive/base/place_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "bihive/base/open_file.h"
#include "bihive/base/output_place.h"

namespace bihive {
namespace {

// Some file systems (vfat, CIFS) have neither owners nor permissions. The file is just as good without them.
void give_owner(int file, const OutputPlace& owner) {
  mode_t mode = owner.mode;
  struct stat info {};
  if (::fstat(file, &info) == 0 && (info.st_uid != owner.user || info.st_gid != owner.group) &&
      ::fchown(file, owner.user, owner.group) != 0) {
    // A group other than before gets no more rights than everybody.
    mode &= ~static_cast<mode_t>(S_IRWXG) | (mode & S_IRWXO) << 3;
  }
  (void)::fchmod(file, mode);
}

// 0 or an errno.
int copy_over(int from, const std::string& path) {
  const Descriptor target(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW));
  if (target.get() < 0) return errno;
  char buffer[1 << 16];
  std::int64_t size = 0;
  for (;;) {
    const ssize_t count = ::read(from, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) break;
    if (const int code = write_whole(target.get(), {buffer, static_cast<std::size_t>(count)}); code != 0) return code;
    size += count;
  }
  if (::ftruncate(target.get(), static_cast<off_t>(size)) != 0 || ::fsync(target.get()) != 0) return errno;
  return 0;
}

}  // namespace

Result<std::string> path_behind_links(const std::string& output) {
  const Result<OutputPlace> place = find_output(output);
  if (!place) return place.error();
  if (!place->regular()) return Error{"is not a regular file", output, 0, 0, "name a file"};
  return place->path;
}

Status place_file(int folder, const std::string& name, const std::string& output, const std::string& like) {
  const Result<OutputPlace> place = find_output(output);
  if (!place) return place.error();
  if (!place->regular()) return Error{"is not a regular file", output, 0, 0, "name a file"};
  const Descriptor file(::openat(folder, name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0) return system_error("cannot be written", output, errno);
  if (!S_ISREG(info.st_mode)) return Error{"cannot be written: " + name + " is not a regular file", output, 0, 0, ""};

  // Owner and permissions, before the file is seen.
  if (place->kind == OutputPlace::Kind::replaced) {
    give_owner(file.get(), *place);
  } else if (place->kind == OutputPlace::Kind::fresh && !like.empty()) {
    const Result<OutputPlace> other = find_output(like);
    if (other && other->regular() && other->kind != OutputPlace::Kind::fresh) give_owner(file.get(), *other);
  }
  if (const int code = flush_to_disk(file.get()); code != 0) return system_error("writing failed", output, code);

  // Replace the output.
  if (place->kind == OutputPlace::Kind::in_place) {
    if (const int code = copy_over(file.get(), place->path); code != 0)
      return system_error("writing failed", output, code,
                          "it is a mount point and was written in place, so it may hold a part now");
    ::unlinkat(folder, name.c_str(), 0);
    return Done{};
  }
  const Descriptor target(::open(place->folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const int there = target.get() >= 0 ? target.get() : AT_FDCWD;
  const std::string& new_name = target.get() >= 0 ? place->name : place->path;
  if (::renameat(folder, name.c_str(), there, new_name.c_str()) != 0)
    return system_error("cannot be written", output, errno);
  return Done{};
}

}  // namespace bihive
