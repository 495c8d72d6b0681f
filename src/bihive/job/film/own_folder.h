// A folder of a film, opened once: all later work goes through its descriptor and reaches this folder, even if its name
// is reused. Links in it are not followed, and files of other users are refused, because they may lead anywhere.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/open_file.h"

namespace bihive {

/// Permissions of new files, before the user's mask: those of an output, and of what bihive itself reads again.
inline constexpr mode_t kOfOutputs = 0666, kOwnerWrites = 0644;

/// All functions fail with kBadInput.
class OwnFolder {
 public:
  /// A folder that no other user may write to. Nothing: there is none. Fails if it is a link, or if another user owns
  /// it or may write to it.
  static std::optional<OwnFolder> open_private(const std::string& path);
  /// A folder of pictures, which may be shared with others. A link to it is followed if it belongs to this user or to
  /// the owner of the folder that contains it.
  static std::optional<OwnFolder> open_shared(const std::string& path);

  int descriptor() const { return folder_.get(); }
  const std::string& path() const { return path_; }
  std::string path_of(const std::string& name) const { return path_ + "/" + name; }
  void set_path(std::string path) { path_ = std::move(path); }

  /// All names in it except "." and "..".
  std::vector<std::string> names() const;
  /// Whether the name exists, even as a dangling link.
  bool has(const std::string& name) const;

  /// A file of this user, with no other name, that no other user may write to; `flags` as of open(). Nothing: there is
  /// none. With O_CREAT it is made for its owner alone.
  std::optional<Descriptor> open_file(const std::string& name, int flags) const;
  /// All bytes of such a file.
  std::optional<std::string> read(const std::string& name) const;
  /// Opens a regular file of this user for reading.
  std::optional<Descriptor> open_picture(const std::string& name) const;

  /// A new file with these bytes, flushed to the disk; `mode` as of open(). False: the name is taken.
  bool write_new(const std::string& name, std::string_view bytes, mode_t mode) const;
  /// The same, and the file is never visible before it is complete, however the program ends.
  bool place_new(const std::string& name, std::string_view bytes, mode_t mode) const;

  void rename(const std::string& from, const std::string& to) const;
  /// Ignores failure.
  void remove(const std::string& name) const;

 private:
  OwnFolder(Descriptor folder, std::string path) : folder_(std::move(folder)), path_(std::move(path)) {}
  bool is_ours(const struct stat& info) const;
  void check_is_private() const;

  Descriptor folder_;
  std::string path_;
  bool is_private_ = false;
};

}  // namespace bihive
