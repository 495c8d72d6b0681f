// The parameters that somebody has set, and nothing else: a layer over the settings of a scene or a style.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/settings/parameter.h"

namespace bihive {

/// Values of some parameters. A parameter may be set to the value that the layer below has.
class Overrides {
 public:
  /// The parameter must exist, and the value fit it; a whole number is a number too.
  void set(std::string_view id, SettingValue value);
  /// Restores the value of the layer below.
  void reset(std::string_view id);

  bool has(std::string_view id) const { return find(id) != nullptr; }
  /// Null: not set.
  const SettingValue* find(std::string_view id) const;
  /// Whether a flag is set and on.
  bool is_on(std::string_view id) const;
  bool empty() const { return values_.empty(); }
  /// Parameters and values, in the order of the table.
  std::vector<std::pair<const Parameter*, const SettingValue*>> all() const;

  /// Puts the values over those of `settings`. A parameter that implies another switches it on first; an explicit value
  /// of the other overrides that. Colours as text count under the transfer curve that results.
  void apply_to(PictureSettings& settings) const;

 private:
  std::vector<std::pair<const Parameter*, SettingValue>> values_;  // in the order of the table
};

/// A JSON object with the id and the value of each.
std::string overrides_to_json(const Overrides& overrides);

/// Whether the fog of a style is left out: in a picture with a legend, so that colours equal their keys, unless the
/// scene or its user asks for fog. `picture`: the result of all layers.
bool leaves_out_fog(const PictureSettings& picture, const Overrides& user, bool scene_states_fog);

/// Two layers: the settings of a scene, and over them those of its user.
struct LayeredSettings {
  PictureSettings below;
  Overrides user;

  PictureSettings result() const;
  /// The user's value, else the one below. Members of something switched off keep their values.
  SettingValue value(const Parameter& parameter) const;
};

}  // namespace bihive
