#include "bihive/job/look_options.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "bihive/base/setting_name.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/selection.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/look_text.h"
#include "bihive/select/selection.h"

namespace bihive {
namespace {

void recolour(LoadedScene& input, const std::string& choice) {
  std::optional<ElementColours> colours = element_colours_called(choice);
  if (!colours) colours = value_or_fail(read_element_colours(value_or_fail(read_file(choice)), choice));
  if (const Status status = recolour_elements(input.scene, *colours); !status)
    fail_setting("element_colours", ": " + status.error().message, "leave it out");
}

// ": no sphere has chain 'a'; there are A, B", where that can be said.
std::string because(const LoadedScene& input, const std::string& selection) {
  const std::string reason = what_there_is(input.scene.spheres, selection);
  return reason.empty() ? reason : ": " + reason;
}

std::size_t colourings_of(const std::vector<Look>& looks) {
  std::size_t count = 0;
  for (const Look& one : looks)
    for (const LookAction& action : one.actions) count += std::holds_alternative<ColourBy>(action) ? 1 : 0;
  return count;
}

}  // namespace

void LookOptions::add(LookAction action, const std::string& name) {
  const std::string setting = setting_of_option(name);
  without_action_.reset();
  if (!has_current_) {
    has_current_ = true;
    current_ = looks.size();
    looks.emplace_back();
    of_look.push_back(setting);
  }
  looks[current_].actions.push_back(std::move(action));
  of_actions.resize(looks.size());
  of_actions[current_].push_back(setting);
}

void LookOptions::add_row(const std::string& action, const std::string& value) {
  rows.push_back({looks[current_].select, action, value});
}

void LookOptions::select(const std::string& text) {
  if (const Status status = check_selection(text); !status) fail_selection("select", text, status.error());
  check_for_action();
  without_action_ = text;
  selected = true;
  has_current_ = true;
  current_ = looks.size();
  looks.push_back({text, {}});
  of_look.emplace_back("select");
  words.push_back(option_of_setting("select") + " " + text);
}

void LookOptions::check_for_action() const {
  if (without_action_)
    fail_setting("select", " \"" + *without_action_ + "\" has no action after it, and changes nothing",
                 "what is done to its spheres comes after it, such as " + setting_name("colour") + " or " +
                     setting_name("hide"));
}

void LookOptions::show(bool shown) {
  const std::string name = shown ? "show" : "hide";
  add(SetShown{shown}, name);
  add_row(name, "");
  words.push_back("--" + name);
}

Status LookOptions::act(const std::string& name, const std::string& given) {
  std::string text = given;
  if (const std::string file = name == "colour-by" ? colour_map_file(given) : ""; !file.empty()) {
    colour_map_files.push_back(file);
    const Result<std::string> bytes = read_file(file);
    if (!bytes) return bytes.error();
    const Result<std::vector<std::uint32_t>> colours = read_colour_map(*bytes, file);
    if (!colours) return colours.error();
    text = with_map(given, *colours);
  }
  Result<LookAction> action = look_action_from_text(name, text);
  if (!action) return action.error();
  add(std::move(*action), name);
  add_row(name, text);
  words.push_back("--" + name + " " + text);
  return Done{};
}

Status LookOptions::set_nan_colour(const std::string& text) {
  if (const Result<ColourChoice> colour = colour_choice_from_text(text); !colour) return colour.error();
  nan_colour = text;
  words.push_back(option_of_setting("nan_colour") + " " + text);
  return Done{};
}

void LookOptions::hide_word(const std::string& id, const std::string& word) {
  looks.push_back({word, {SetShown{false}}});
  of_look.push_back(id);
  rows.push_back({word, "hide", ""});
  words.push_back(option_of_setting(id));
  if (!has_current_) return;
  // Later actions apply to the previous selection, but come after this one.
  looks.push_back({looks[current_].select, {}});
  of_look.push_back(of_look[current_]);
  current_ = looks.size() - 1;
}

namespace {

// None is left to be seen.
void remove_spheres(Scene& scene) {
  scene.spheres = {};
  scene.material_of_sphere.clear();
  scene.id_in_input.clear();
  scene.coloured_by.clear();
  scene.coloured_by_of_sphere.clear();
  scene.legend_names.clear();
}

}  // namespace

void look(LoadedScene& input, const LookOptions& options, const std::vector<ColourRange>& ranges, bool may_be_empty) {
  if (may_be_empty && input.scene.spheres.empty()) return;
  if (!options.element_colours.empty()) recolour(input, options.element_colours);
  std::vector<Look> looks = input.looks;
  for (Look one : options.looks) {
    for (LookAction& action : one.actions)
      if (auto* const how = std::get_if<ColourBy>(&action); how != nullptr && !options.nan_colour.empty())
        how->nan_colour = *colour_choice_from_text(options.nan_colour);
    looks.push_back(std::move(one));
  }
  options.check_for_action();
  std::size_t next = 0;
  for (Look& one : looks)
    for (LookAction& action : one.actions)
      if (auto* const how = std::get_if<ColourBy>(&action); how != nullptr && next < ranges.size()) {
        if (!how->range) how->range = ranges[next];
        ++next;
      }
  if (looks.empty()) return;

  std::size_t failed = 0, failed_action = 0;
  const auto counts = apply_looks(input.scene, looks, &failed, &failed_action);
  const std::size_t own = input.looks.size();
  if (!counts) {
    const Error& error = counts.error();
    if (failed == looks.size() && may_be_empty) return remove_spheres(input.scene);
    if (failed == looks.size()) fail_usage(error.message, error.hint);
    if (failed < own) {
      const std::string place = error.column > 0 ? "/select: column " + std::to_string(error.column) : "";
      fail({"/looks/" + std::to_string(failed) + place + ": " + error.message, input.scene.name, 0, 0, error.hint});
    }
    const bool is_of_action =
        failed - own < options.of_actions.size() && failed_action < options.of_actions[failed - own].size();
    if (is_of_action) fail_setting(options.of_actions[failed - own][failed_action], ": " + error.message, error.hint);
    fail_selection(options.of_look[failed - own], looks[failed].select, error);
  }
  for (std::size_t i = own; i < looks.size(); ++i)
    if ((*counts)[i] == 0 && options.of_look[i - own] == "select" && !looks[i].actions.empty())
      warn(setting_name("select") + " \"" + looks[i].select + "\" selects no sphere" + because(input, looks[i].select));
}

std::vector<ColourRange> ranges_of_looks(const LoadedScene& input, const LookOptions& options) {
  // The meanings of the looks' colours follow that of the style.
  const std::vector<ColourBy>& meanings = input.scene.coloured_by;
  const std::size_t count = std::min(meanings.size(), colourings_of(input.looks) + colourings_of(options.looks));
  std::vector<ColourRange> ranges;
  ranges.reserve(count);
  for (std::size_t i = meanings.size() - count; i < meanings.size(); ++i) ranges.push_back(meanings[i].range);
  return ranges;
}

ColourRange range_of_style(const LoadedScene& input, const LookOptions& options) {
  const std::size_t of_looks = colourings_of(input.looks) + colourings_of(options.looks);
  return input.scene.coloured_by.size() > of_looks ? input.scene.coloured_by.front().range : std::nullopt;
}

void give_extent(ColourRange& range) {
  if (!range || range->first < range->second) return;
  const double value = range->first;
  const double half = value != 0 ? std::abs(value) / 2 : 0.5;
  range = {value - half, value + half};
}

void fix_range(Style& style, const ColourRange& range) {
  if (style.colour_by && !style.colour_by->range) style.colour_by->range = range;
}

}  // namespace bihive
