// What somebody has set, and nothing else: a layer over the settings of a scene or a style.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/settings/parameter.h"

namespace bihive {

/// Values of some parameters. That one is set is known, also where its value is that of the layer below.
class Overrides {
 public:
  /// The parameter must exist, and the value fit it; a whole number is a number too.
  void set(std::string_view id, SettingValue value);
  /// What is below shows again.
  void reset(std::string_view id);

  bool has(std::string_view id) const { return find(id) != nullptr; }
  /// Null: not set.
  const SettingValue* find(std::string_view id) const;
  /// A flag that is set and on.
  bool is_on(std::string_view id) const;
  bool empty() const { return values_.empty(); }
  /// Parameters and values, in the order of the table.
  std::vector<std::pair<const Parameter*, const SettingValue*>> all() const;

  /// Puts the values over those of `settings`. A parameter that implies another one switches that on first; a value of
  /// that one has the last word. Colours as text count under the transfer curve that results.
  void apply_to(PictureSettings& settings) const;

 private:
  std::vector<std::pair<const Parameter*, SettingValue>> values_;  // in the order of the table
};

/// A JSON object with the id and the value of each.
std::string overrides_to_json(const Overrides& overrides);

/// Two layers: the settings of a scene, and over them those of its user.
struct LayeredSettings {
  PictureSettings below;
  Overrides user;

  PictureSettings result() const;
  /// The user's value, else the one below. A part of what is switched off keeps its value.
  SettingValue value(const Parameter& parameter) const;
};

}  // namespace bihive
