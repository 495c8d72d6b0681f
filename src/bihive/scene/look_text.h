// Looks as a person writes them: the options of `bihive render` behind --select, each with the text of its value.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/looks.h"

namespace bihive {

/// Names that an action's value may have.
enum class ValueNames { none, colours, materials, attributes };

/// A row of the table of actions: its option, and its controls.
struct LookActionText {
  std::string_view name;          ///< the option's: "radius-scale"
  std::string_view label = "";    ///< where the name says too little; empty: the name
  std::string_view value = "";    ///< what its value is: "a colour"; empty: it has none
  std::string_view example = "";  ///< "orange or #ff8800"
  ValueNames names = ValueNames::none;
  bool is_number = false;
  /// Error: the value is none for it; the message says what was expected.
  Result<LookAction> (*from_text)(const std::string& value) = nullptr;
};

std::span<const LookActionText> look_actions();
/// Null: there is no action of that name.
const LookActionText* look_action_named(std::string_view name);
/// hide, show, colour ...: the options' names.
const std::vector<std::string>& look_action_names();

/// One action on selected spheres, as texts that the user may still have to mend.
struct LookRow {
  std::string select;  ///< docs/selections.md; empty: all
  std::string action;  ///< one of look_action_names()
  std::string value;   ///< as after the option; empty for hide and show

  friend bool operator==(const LookRow& a, const LookRow& b) {
    return a.select == b.select && a.action == b.action && a.value == b.value;
  }
};

/// The action of that name. `value`: as behind the option; hide and show have none and ignore it. Error: there is no
/// such action, or the value is none for it; the message says what was expected.
Result<LookAction> look_action_from_text(std::string_view name, const std::string& value);

/// The names of colours that colour_choice_from_text() knows.
std::vector<std::string> colour_names();

/// A text that means a colour: a name, "#rrggbb", or "r,g,b" (linear, each 0 to 1). Names and #rrggbb stay texts,
/// because their light depends on the scene's transfer.
Result<ColourChoice> colour_choice_from_text(const std::string& text);

}  // namespace bihive
