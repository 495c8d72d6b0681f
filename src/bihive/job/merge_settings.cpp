#include "bihive/job/merge_settings.h"

#include <algorithm>
#include <cstddef>

#include "bihive/base/setting_name.h"
#include "bihive/job/picture_options.h"

namespace bihive {
namespace {

using Settings = std::vector<GivenSetting>;

bool is_action(const std::string& id) {
  const RequestOption<PictureRequest>* const row = picture_option(id);
  return row != nullptr && row->repeatable && row->theme == OptionTheme::spheres;
}

// Whether a change makes a kept setting void.
bool replaces(const std::string& change, const std::string& kept) {
  if (change == kept) return true;
  const auto excludes = [](const std::string& id, const std::string& other) {
    const RequestOption<PictureRequest>* const row = picture_option(id);
    return row != nullptr && std::find(row->excludes.begin(), row->excludes.end(), other) != row->excludes.end();
  };
  if (excludes(change, kept) || excludes(kept, change)) return true;
  const auto is_colour = [](const std::string& id) { return id == "colour" || id == "colour_by"; };
  return is_colour(change) && is_colour(kept);
}

// The value of the next colour_by among the options as understood: with colours in place of a map's file.
std::string next_colour_by(const std::vector<std::string>& words, std::size_t& next) {
  const std::string option = option_of_setting("colour_by") + " ";
  while (next < words.size() && !words[next].starts_with(option)) ++next;
  return next < words.size() ? words[next++].substr(option.size()) : "";
}

}  // namespace

Settings ordered_settings(const PictureRequest& request) {
  Settings settings = request.given;
  std::size_t next_word = 0;
  for (GivenSetting& one : settings)
    if (one.id == "colour_by") one.value = next_colour_by(request.looks.words, next_word);
  const auto place = [](const GivenSetting& one) {
    return is_action(one.id) ? picture_options().size()
                             : static_cast<std::size_t>(picture_option(one.id) - picture_options().data());
  };
  std::stable_sort(settings.begin(), settings.end(),
                   [&](const GivenSetting& a, const GivenSetting& b) { return place(a) < place(b); });
  return settings;
}

void merge_settings(PictureRequest& request, const Settings& kept, const Settings& changes,
                    const std::function<std::string(const GivenSetting&)>& value_of) {
  // Of a command line, actions on spheres come before all other options.
  Settings of_all, of_selected;
  for (const GivenSetting& one : changes) {
    const bool is_selected = is_action(one.id) && (one.id == "select" || !of_selected.empty());
    (is_selected ? of_selected : of_all).push_back(one);
  }
  const auto take = [&request](const GivenSetting& one) { take_setting(request, one.id, one.value); };
  std::for_each(of_all.begin(), of_all.end(), take);
  // Kept actions after a selection stay; anything else gives way to a change.
  bool selected = false;
  for (const GivenSetting& one : kept) {
    selected = selected || one.id == "select";
    const auto gives_way = [&one](const GivenSetting& change) { return replaces(change.id, one.id); };
    const bool stays = (selected && is_action(one.id)) || std::none_of(of_all.begin(), of_all.end(), gives_way);
    if (stays) take_setting(request, one.id, value_of ? value_of(one) : one.value);
  }
  std::for_each(of_selected.begin(), of_selected.end(), take);
}

}  // namespace bihive
