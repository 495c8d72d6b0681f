// The folder of a film before its first picture is complete: it has an unguessable name, and a lock, so that the next
// run can recognise what a killed one has left. Also the names of all files that bihive makes in the folder of a film.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/job/film/own_folder.h"

namespace bihive {

inline constexpr const char* kLockOfFilm = "lock";

/// An open folder, to name files in it: no right to list it is needed. Fails with kBadInput.
Descriptor open_parent(const std::string& path);

struct HiddenFolder {
  std::string name;  ///< in its parent
  OwnFolder folder;
  Descriptor lock;
};

/// Creates one for this user alone; `kind`: LOCK_EX or LOCK_SH. Fails with kBadInput.
HiddenFolder make_hidden_folder(int parent, const std::string& path_of_parent, int kind);

/// A name for such a folder.
std::string hidden_name();

/// The lock of a film's folder, released when the program ends, however it ends. Nothing: another run has it. Not every
/// file system has locks.
std::optional<Descriptor> lock_folder(const OwnFolder& folder, int kind);

/// Whether the folder contains only what bihive makes there.
bool all_own(const OwnFolder& folder);

/// Removes what bihive has made, the lock last; `known`: more names, if the folder cannot be listed.
void remove_own_files(const OwnFolder& folder, std::vector<std::string> known = {});

/// Removes the hidden folders that killed runs of this user left. A living run has locked its own.
void remove_leftovers(int parent, const std::string& path_of_parent);

}  // namespace bihive
