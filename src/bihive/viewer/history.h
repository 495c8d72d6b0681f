// The states that a scene has been in, for undo and redo.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bihive/viewer/command_text.h"

namespace bihive {

class History {
 public:
  /// Another scene, which has no past.
  void begin(const ShownState& state);
  /// The state that is shown now. Changes of the same things within a second are one. A state that the user did not
  /// make takes the place of the last. Of an input, its count and its seed nothing is kept, nor of the picture's size.
  void note(const ShownState& state, bool by_user, double now_ms);

  /// Describes what undo (-1) or redo (1) would change; empty if there is nothing to undo or redo.
  std::string next(int by) const;
  /// Goes one back (-1) or on (1), and returns the state there; null: there is none. It lives until the next call.
  const ShownState* go(int by);

 private:
  struct Entry {
    ShownState state;
    std::string reading, settings, look;  // as JSON
  };
  static Entry entry_of(const ShownState& state);
  static std::vector<std::string> changed_members(const Entry& a, const Entry& b);
  const Entry* entry_at(int by) const;

  std::vector<Entry> entries_;
  std::size_t at_ = 0;
  std::vector<std::string> last_change_;  // members of the newest change
  double last_ms_ = 0;                    // when it was
};

}  // namespace bihive
