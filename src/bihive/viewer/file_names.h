// Names of files as somebody types them: the list of those that may be meant, and their completion.
#pragma once

#include <string>
#include <vector>

namespace bihive {

/// "~" or "~/x" with the user's own folder in place of "~"; other paths are unchanged.
std::string with_home(const std::string& path);

struct FileName {
  std::string name;  ///< without its folder
  bool is_folder = false;
};

/// The entries of the folder of a typed path whose names begin with what is typed after the last slash, whatever the
/// case of letters: folders first, then files, each by name. Hidden ones are left out unless a full stop is typed.
/// At most `most`. Empty where there is no such folder.
std::vector<FileName> matching_files(const std::string& typed, std::size_t most = 1000);

/// The typed path with its last name replaced by this one; a folder ends in a slash. "~" stays as typed.
std::string with_last_name(const std::string& typed, const FileName& last);

/// As far as all matches agree; with a single one all of its name. Unchanged where nothing matches.
std::string completed(const std::string& typed, const std::vector<FileName>& matches);

}  // namespace bihive
