// The panel's section for appearance: style, colours of elements, background, and rows of selections with actions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/viewer/viewer.h"

namespace bihive::window {

class LookPanel {
 public:
  /// Draws it; returns the user's new look, if it has changed.
  std::optional<ViewerLook> draw(const Viewer& viewer);

  /// Takes Viewer::set_look()'s answer to the last requested look. Returns the message of an error that is not a row's;
  /// those of rows are shown below their rows.
  std::string answered(const Result<std::vector<std::int64_t>>& counts, std::size_t failed_row);

  /// The next requested look is made by another panel, and has the current rows.
  void leave_rows() { rows_sent_ = false; }

  /// Another scene is shown: its rows come from its look.
  void start_anew(const ViewerLook& look);

 private:
  // A row being edited, and its message.
  struct EditedRow {
    LookRow row;
    std::string words;
    bool is_fault = false;

    bool complete() const;
  };

  bool draw_row(const SceneFacts& facts, std::size_t number, bool& removed);
  bool draw_value(const SceneFacts& facts, LookRow& row) const;

  std::vector<EditedRow> rows_;
  std::vector<std::size_t> sent_;  // positions of the rows in the last requested look with other rows
  bool rows_sent_ = false;         // the last requested look has other rows
};

}  // namespace bihive::window
