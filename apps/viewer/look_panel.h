// The panel's part for the look: style, colours of elements, background, and rows of selections with actions.
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
  /// Draws it; returns the look that the user now wants, if it is another one.
  std::optional<ViewerLook> draw(const Viewer& viewer);

  /// Viewer::set_look()'s answer to the last wanted look. Returns the words of an error that no row is to blame for;
  /// those of rows are shown below their rows.
  std::string answered(const Result<std::vector<std::int64_t>>& counts, std::size_t failed_row);

  /// The next wanted look comes from elsewhere, and has the rows that are on show.
  void leave_rows() { rows_sent_ = false; }

  /// Another scene is on show: its rows come from its look.
  void start_anew(const ViewerLook& look);

 private:
  // A row as it is being edited, and what is said of it.
  struct EditedRow {
    LookRow row;
    std::string words;
    bool is_fault = false;

    bool complete() const;
  };

  bool draw_row(const SceneFacts& facts, std::size_t number, bool& removed);
  bool draw_value(const SceneFacts& facts, LookRow& row) const;

  std::vector<EditedRow> rows_;
  std::vector<std::size_t> sent_;  // positions of the rows in the last wanted look that has other rows
  bool rows_sent_ = false;         // the last wanted look has other rows
};

}  // namespace bihive::window
