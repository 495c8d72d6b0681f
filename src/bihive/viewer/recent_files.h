// Files that were opened before, kept from one run of a program to the next.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bihive {

class RecentFiles {
 public:
  static constexpr std::size_t kMost = 8;

  /// $XDG_STATE_HOME/bihive/recent, or ~/.local/state/bihive/recent; empty: there is no such place.
  static std::string usual_list();

  /// `list`: a file with a path in each line, which need not be there yet; empty: nothing is kept.
  explicit RecentFiles(std::string list);

  /// Absolute, the newest first; only files that are there.
  const std::vector<std::string>& paths() const { return paths_; }
  /// Puts a file in front, also in the list. Of what cannot be written nothing is kept.
  void add(const std::string& path);
  /// Removes the list.
  void forget();

 private:
  std::string list_;
  std::vector<std::string> paths_;
};

}  // namespace bihive
