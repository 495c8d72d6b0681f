// The table of parameters of a picture: one row per setting, from which the options of the command line with their
// help, JSON of scene files, links and reports, the schema, the messages between ranks, controls and bindings are made.
//
// To add a parameter: a member of PictureSettings, a row in picture_parameters.cpp, and the code that draws it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/settings/picture_settings.h"
#include "bihive/settings/setting_value.h"

namespace bihive {

enum class ParameterKind { flag, whole, number, choice, text, colour };

/// The heading below which help and controls show a parameter.
enum class ParameterGroup { picture, light, lines, tone, labels, cell };

/// How ranks read distributed input under a setting: each rank its chunk of the file; one rank the whole file; or the
/// setting is not supported.
enum class ParameterRanks { refused, whole, chunks };

/// The property of a scene or its camera without which a parameter has no effect.
enum class ParameterNeeds { nothing, soft_light, see_through, orthographic };

struct Parameter {
  std::string_view id;          ///< "light_points": in Python, C, and the JSON of window and page
  std::string_view alias = "";  ///< another accepted id
  ParameterKind kind = ParameterKind::flag;
  double least = 0, most = 0;   ///< range of numbers
  bool above_least = false;     ///< `least` itself is out of range
  bool or_zero = false;         ///< 0 is in range too: none
  bool nullable = false;        ///< may be std::monostate
  std::string_view names = "";  ///< of a choice, in the order of the enumeration: "none|soft|filmic"

  std::string_view path = "";    ///< key in `picture` of scene and style files: "fog", or "fog.start"; "": none
  std::string_view report = "";  ///< key in reports and in the text of PNG files; "": none
  int version = 2;               ///< of the scene format that introduced the key
  ParameterNeeds needs = ParameterNeeds::nothing;

  ParameterRanks ranks = ParameterRanks::refused;

  bool has_option = true;         ///< "--" and the id with hyphens; false: another option of the command line sets it
  bool has_no_option = false;     ///< a flag: "--no-..." too
  bool in_window = true;          ///< available in window and page
  bool cpu_only = false;          ///< not drawn by the GPU, which refuses another value than the default
  bool makes_sticks = false;      ///< of bonds, arrows, tubes and the like: they are made anew with the scene
  std::string_view implies = "";  ///< switched on by setting this one, unless set explicitly
  std::string_view value_name = "N";  ///< name of the value in --help
  std::string_view help = "";         ///< one sentence, without a full stop
  std::string_view usual = "";        ///< the default, if help should state it: "the style's"
  ParameterGroup group = ParameterGroup::picture;

  // The control in window and page.
  std::string_view label = "";               ///< "": it has none
  std::string_view long_label = "";          ///< if there is room; "": `label`
  int place = 0;                             ///< order in the group: ascending, equal ones as in the table
  std::string_view choice_labels = "";       ///< of `names`: "cut off|soft|filmic"; "": the names themselves
  std::string_view empty_means = "";         ///< shown in an empty field: "no limit"
  double slider_least = 0, slider_most = 0;  ///< equal: a field instead of a slider
  double slider_step = 1;
  std::string_view unit = "";         ///< after the slider's number; "%": of a share
  std::string_view only_with = "";    ///< a flag without which it changes nothing
  std::string_view replaced_by = "";  ///< a flag that overrides it
  std::string_view note = "";         ///< why it is disabled if engine or camera cannot draw it; a sentence

  SettingValue (*get)(const PictureSettings&) = nullptr;
  /// The value must be in range.
  void (*set)(PictureSettings&, const SettingValue&) = nullptr;
};

/// All rows; one that another one implies comes before it.
std::span<const Parameter> picture_parameters();

/// The first row that GPUs do not draw and whose value is not the default; null: none. Rows of lines are left out: what
/// they ask for are sticks and walls in the scene, which GPUs refuse themselves.
const Parameter* first_cpu_only(const PictureSettings& settings);

/// The row of an id or alias; null: none.
const Parameter* parameter_named(std::string_view id);

/// The names of a choice.
std::vector<std::string> names_of(const Parameter& parameter);

/// The names of a choice as a control shows them.
std::vector<std::string> choice_labels_of(const Parameter& parameter);

/// The parameters of a group that have a control, in the order in which they are shown.
std::vector<const Parameter*> controls_of(ParameterGroup group);

/// "a whole number from 1 to 16", "one of none, soft, filmic".
std::string expected_by(const Parameter& parameter);

/// Whether the value has the parameter's kind and is in range. A colour may be text.
bool fits(const Parameter& parameter, const SettingValue& value);

/// "--light-points".
std::string option_of(const Parameter& parameter);

}  // namespace bihive
