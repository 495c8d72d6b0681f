// The destination of an output: the user's path with its links followed, and the obstacles to writing there.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive {

struct OutputPlace {
  enum class Kind {
    fresh,       ///< no file is there
    replaced,    ///< a regular file is there
    in_place,    ///< a regular file that no other file can replace, because it is a mount point
    stream,      ///< a pipe, a device or a socket
    descriptor,  ///< a file that this program has open already: /dev/stdout, /dev/fd/3
  };
  Kind kind = Kind::fresh;
  std::string path;          ///< after all links
  std::string folder, name;  ///< of a regular file
  int descriptor = -1;
  unsigned mode = 0, user = 0, group = 0;  ///< of the file that is there; mode: permissions only
  unsigned long long device = 0, inode = 0;

  bool regular() const { return kind == Kind::fresh || kind == Kind::replaced || kind == Kind::in_place; }
};

/// An Error if the path can surely not be written to: a missing folder, a path that is itself a folder, no permission,
/// a file that is immutable, belongs to somebody else, or is in a folder where files can only be added. A link in a
/// folder to which everybody may write (/tmp) is followed if it belongs to this user or to the folder's owner, as Linux
/// does by fs.protected_symlinks in those of them that are sticky.
Result<OutputPlace> find_output(const std::string& path);

/// Whether both resolve to one file: by the file that is there, else by folder and name.
bool same_place(const OutputPlace& a, const OutputPlace& b);

/// An Error about a file, with the system's reason.
Error system_error(const std::string& what, const std::string& path, int code, const std::string& hint = "");

}  // namespace bihive
