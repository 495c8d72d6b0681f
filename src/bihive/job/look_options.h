// The options of `bihive render` that change the appearance of selected spheres, in the order of the command line.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/looks.h"

namespace bihive {

/// Each function takes the value of one option, in the order of the command line. An action before any --select applies
/// to all spheres. An error states what was expected.
struct LookOptions {
  std::vector<Look> looks;
  std::vector<std::string> of_look;                  ///< for messages: the id of the option that starts each look
  std::vector<std::vector<std::string>> of_actions;  ///< and those of its actions
  std::vector<std::string> words;                    ///< the options as given, one string each
  std::vector<LookRow> rows;                         ///< the same for the window: one action each, as text
  std::string nan_colour;                            ///< empty: the default
  std::string element_colours;                       ///< "cpk", "jmol" or a file; empty: the usual ones
  std::vector<std::string> colour_map_files;         ///< read for colour_by
  bool selected = false;                             ///< --select was given

  /// Fails with kBadUsage on a text that is not a selection, and shows the faulty column.
  void select(const std::string& text);
  void show(bool shown);
  Status set_nan_colour(const std::string& text);
  /// colour, colour-by, opacity, material, radius-scale, outline, crease, clip.
  Status act(const std::string& name, const std::string& text);
  /// Fails with kBadUsage on a selection with no action after it.
  void check_for_action() const;
  /// no_hydrogens and no_water: hides what the word selects; the selection of the next actions stays.
  void hide_word(const std::string& id, const std::string& word);

 private:
  void add(LookAction action, const std::string& name);
  void add_row(const std::string& action, const std::string& value);
  std::size_t current_ = 0;  // the look that takes actions, if there is any
  bool has_current_ = false;
  std::optional<std::string> without_action_;  // the last selection, until its first action
};

/// The range of the numbers that the colours represent; unset: not stated, or none.
using ColourRange = std::optional<std::pair<double, double>>;

/// Sets element colours, applies the input's own looks, then these. Fails with kBadInput on a file of colours that
/// cannot be read. Fails with kBadUsage on a selection or action that does not fit the input.
/// Warns of a --select without spheres. `ranges`: for each action that colours by an attribute, in their order, those
/// of the input first; they replace ranges that the action leaves open. `may_be_empty`: a scene without spheres stays
/// as it is, and one whose spheres are all hidden gets none; else the latter is an error.
void look(LoadedScene& input, const LookOptions& options, const std::vector<ColourRange>& ranges = {},
          bool may_be_empty = false);

/// The ranges by which look() has coloured the input, for its last argument; nothing if colours mean categories. And
/// that of the style with which the input was loaded.
std::vector<ColourRange> ranges_of_looks(const LoadedScene& input, const LookOptions& options);
ColourRange range_of_style(const LoadedScene& input, const LookOptions& options);
/// A range that is kept for other pictures needs an extent: a single number gets the middle of the map.
void give_extent(ColourRange& range);
/// The style with this range, if it colours by an attribute and leaves the range open.
void fix_range(Style& style, const ColourRange& range);

}  // namespace bihive
