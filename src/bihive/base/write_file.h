// Writes files whole or not at all.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

struct OutputPlace;

/// Writes the bytes to a new file in the folder of `path`, flushes it to the disk, and lets it replace `path`. So a
/// reader sees the old file or the whole new one. A symbolic link is followed, also to a file that is not there yet. A
/// pipe or a device is written directly; /dev/stdout and /dev/fd/N continue at that stream's offset. After an error
/// (missing folder, no permission, full disk) no partial file is left. One exception: a mount point cannot be replaced,
/// so it is written in place, after all bytes are there. The new file keeps the permissions and the owner of the
/// previous one, but neither setuid nor setgid.
Status write_file(const std::string& path, std::string_view bytes);

/// A file that is written piece by piece, and appears under its path only when it is complete: for files that do not
/// fit into memory. The rules of write_file() for paths hold here too.
///
/// The bytes lie in a file without a name where the system has such (O_TMPFILE), so that SIGKILL leaves nothing.
/// Elsewhere it has a random name, ".bihive-....part", in the folder of its path; so has, for a moment, every file that
/// replaces another one. A program that writes into that folder later removes what a killed program left there
/// (aside_file.h).
class GrowingFile {
 public:
  /// Makes the new file, or opens the pipe or the device.
  static Result<GrowingFile> begin(const std::string& path);
  /// A file that is not finished is removed.
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;

  /// Appends.
  Status append(std::string_view bytes);
  /// Overwrites earlier bytes, or extends the file. Error: a pipe, which cannot seek.
  Status write_at(std::uint64_t place, std::string_view bytes);
  /// Flushes it to the disk and gives it its path. The last call.
  Status finish();
  /// Finishes all of them, or none: after an Error each path is as it was. The last call for each.
  static Status finish_together(std::vector<GrowingFile>& files);

  /// False for a pipe, a device or a stream, where nothing written can be undone.
  bool can_go_back() const;
  /// The path of the file until finish(); empty if it has no name.
  std::string path_aside() const;

 private:
  GrowingFile();
  Status failed(int code) const;
  Status open_aside(const std::string& folder);
  void choose_names();
  int name_aside();
  int settle();
  int copy_in_place();
  int put_old_aside(bool& exchanged);
  int take_place(bool keep_old);
  void undo();
  void remove_old();

  int file_ = -1;
  int folder_ = -1;    // of the file and its neighbours
  int old_file_ = -1;  // the file before, while old_ names it
  std::uint64_t size_ = 0;
  std::string given_path_;
  std::unique_ptr<OutputPlace> place_;
  std::string folder_aside_;  // of the new file
  std::string aside_;         // the new file's name in its folder; empty: none
  std::string old_;           // name of the previous file while several files are replaced; empty: none
  std::string spare_name_;    // for old_
  std::string kept_name_;     // for old_, where it is the only name
  std::string new_name_;      // for aside_
  std::string link_from_;     // the path of a file without a name
  bool placed_ = false;
};

/// An error if write_file(path) would surely fail now (missing folder, a path that is itself a folder, no permission).
/// Call it before long work, so that the user sees the error at once. It makes a file without a name, and leaves
/// nothing.
Status check_writable(const std::string& path);

/// Whether what is written to `path` is a stream: a pipe, a device, /dev/stdout. False if the path is not writable.
bool is_stream(const std::string& path);

/// Whether `path` is the standard output by name: /dev/stdout, /dev/fd/1, or another descriptor of the same file.
bool is_standard_output(const std::string& path);

/// Whether both are one regular file, by links or by other names; also if it is not there yet.
bool is_same_file(const std::string& a, const std::string& b);

/// The whole file, as long as it was when it was opened: `grew` (if not null) says whether it has become longer
/// meanwhile. Errors: missing, a folder, unreadable, longer than the memory (base/memory.h), or no memory left for it.
Result<std::string> read_file(const std::string& path, bool* grew = nullptr);

/// All bytes of an open file from its current offset on; `name` is for messages.
Result<std::string> read_descriptor(int descriptor, const std::string& name, bool* grew = nullptr);

}  // namespace bihive
