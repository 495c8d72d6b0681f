// The rows of the look: selections, each with an action and its value, as the cards "Show" and "Cut" and the legend
// edit them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/viewer/viewer.h"

namespace bihive::window {

class LookRows {
 public:
  /// Draws the rows and a button that adds one.
  void draw(const SceneFacts& facts);

  /// The value of the row of a selection and an action; nothing: there is none.
  std::optional<std::string> value(const std::string& select, const std::string& action) const;
  /// Changes, adds or removes it.
  void set(const std::string& select, const std::string& action, const std::optional<std::string>& value);
  /// Adds a row that waits for its value.
  void begin(const std::string& select) { rows_.push_back({{select, "colour", ""}, "", false}); }

  /// If rows have changed since the last call, puts the complete ones into the look; the others wait.
  void put_into(ViewerLook& look);

  /// Takes Viewer::set_look()'s answer to the last requested look. Returns the message of an error that is not a row's;
  /// those of rows are shown below their rows.
  std::string answered(const Result<std::vector<std::int64_t>>& counts, std::size_t failed_row);

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
  bool changed_ = false;           // since the last put_into()
  bool rows_sent_ = false;         // the last requested look has other rows
};

}  // namespace bihive::window
