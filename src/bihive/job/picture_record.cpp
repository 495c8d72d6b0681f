#include "bihive/job/picture_record.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/sha256.h"
#include "bihive/base/version.h"
#include "bihive/io/data_path.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/report_text.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;
using Settings = std::vector<GivenSetting>;

constexpr int kRecordVersion = 1;

// Settings that change no pixel: all engines of the CPU and all their trees give the same bits.
bool changes_nothing(const GivenSetting& setting, View view) {
  const bool shows_tree = view == View::traversal || view == View::tree;
  return setting.id == "threads" || (setting.id == "engine" && !setting.value.starts_with("gpu")) ||
         ((setting.id == "max_prims" || setting.id == "max_depth") && !shows_tree);
}

bool is_action(const std::string& id) {
  const RequestOption<PictureRequest>* const row = picture_option(id);
  return row != nullptr && row->repeatable && row->theme == OptionTheme::spheres;
}

std::string without_folder(const std::string& path) {
  const std::string file = data_path(path).file;
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

// Empty if the file cannot be read.
std::string sha256_at(const std::string& path) {
  const Result<std::string> digits = sha256_of_file(data_path(path).file);
  return digits ? *digits : "";
}

RecordedFile recorded_file(const std::string& option, const std::string& path) {
  return {option, without_folder(path), sha256_at(path)};
}

// The path of a recorded file that lies beside the figure or in the current folder. Its name is data from a file, so a
// name with a folder is none.
std::string found_file(const RecordedFile& file, const std::string& folder) {
  const std::string name = file.name.substr(0, file.name.find(":/"));
  const bool is_name =
      !name.empty() && name.front() != '.' && name.front() != '-' && name.find('/') == std::string::npos;
  std::error_code none;
  if (is_name)
    for (const std::string& place : {folder + "/", std::string()})
      if (const std::string path = place + file.name; std::filesystem::is_regular_file(data_path(path).file, none))
        return path;
  const bool is_input = file.option == kInputFile;
  fail_usage("the figure was drawn from the file " + file.name +
                 (is_input ? "" : " (" + setting_name(file.option) + ")") + ", which is neither beside it nor here",
             is_input ? "name the input after the figure" : "give " + setting_name(file.option) + " with its path");
}

// Whether a change makes a recorded setting void.
bool replaces(const std::string& change, const std::string& recorded) {
  if (change == recorded) return true;
  const auto excludes = [](const std::string& id, const std::string& other) {
    const RequestOption<PictureRequest>* const row = picture_option(id);
    return row != nullptr && std::find(row->excludes.begin(), row->excludes.end(), other) != row->excludes.end();
  };
  if (excludes(change, recorded) || excludes(recorded, change)) return true;
  const auto is_colour = [](const std::string& id) { return id == "colour" || id == "colour_by"; };
  return is_colour(change) && is_colour(recorded);
}

// The value of the next colour_by among the options as understood: with colours in place of a map's file.
std::string next_colour_by(const std::vector<std::string>& words, std::size_t& next) {
  const std::string option = option_of_setting("colour_by") + " ";
  while (next < words.size() && !words[next].starts_with(option)) ++next;
  return next < words.size() ? words[next++].substr(option.size()) : "";
}

Settings::const_iterator first_selection(const Settings& settings) {
  return std::find_if(settings.begin(), settings.end(), [](const GivenSetting& one) { return one.id == "select"; });
}

ordered_json pairs(const Settings& settings) {
  ordered_json json = ordered_json::array();
  for (const GivenSetting& one : settings) json.push_back({one.id, one.value});
  return json;
}

}  // namespace

PictureRecord record_of(const PictureRequest& request, std::string pixels_sha256) {
  PictureRecord record{std::string(version()), std::string(commit()), "", {}, {}, std::move(pixels_sha256)};
  const std::string& input = request.input.input;
  if (is_built_in_scene(input))
    record.built_in = input;
  else if (!input.empty() && input != kStandardStream)
    record.files.push_back(recorded_file(kInputFile, input));
  std::size_t next_word = 0;
  for (GivenSetting one : request.given) {
    if (changes_nothing(one, request.view)) continue;
    if (one.id == "colour_by") one.value = next_colour_by(request.looks.words, next_word);
    if (!names_file(one.id, one.value)) record.settings.push_back(std::move(one));
  }
  for (const GivenSetting& file : files_named_by(request))
    if (file.id != "colour_by") record.files.push_back(recorded_file(file.id, file.value));
  // Actions in their order after everything else, whose order means nothing: the same in every front end.
  const auto place = [](const GivenSetting& one) {
    return is_action(one.id) ? picture_options().size()
                             : static_cast<std::size_t>(picture_option(one.id) - picture_options().data());
  };
  std::stable_sort(record.settings.begin(), record.settings.end(),
                   [&](const GivenSetting& a, const GivenSetting& b) { return place(a) < place(b); });
  return record;
}

std::string to_text(const PictureRecord& record) {
  ordered_json json{{"record", kRecordVersion}, {"version", record.version}};
  if (!record.commit.empty()) json["commit"] = record.commit;
  if (!record.built_in.empty()) json["scene"] = record.built_in;
  json["files"] = ordered_json::array();
  for (const RecordedFile& file : record.files)
    json["files"].push_back({{"option", file.option}, {"name", file.name}, {"sha256", file.sha256}});
  json["options"] = pairs(record.settings);
  json["pixels"] = record.pixels_sha256;
  return as_text(json, -1);
}

Result<PictureRecord> picture_record_from(std::string_view text) {
  const Error damaged{"its record of how it was drawn is damaged", "", 0, 0, ""};
  const Result<ordered_json> json = json_from_text<ordered_json>(text);
  if (!json || !json->is_object() || !json->contains("record")) return damaged;
  try {
    if (json->at("record").get<int>() > kRecordVersion)
      return Error{"its record of how it was drawn is of a later version of bihive", "", 0, 0, "use that version"};
    PictureRecord record;
    record.version = json->at("version").get<std::string>();
    record.commit = json->value("commit", "");
    record.built_in = json->value("scene", "");
    if (!record.built_in.empty() && !is_built_in_scene(record.built_in)) return damaged;
    for (const ordered_json& file : json->at("files"))
      record.files.push_back({file.at("option").get<std::string>(), file.at("name").get<std::string>(),
                              file.at("sha256").get<std::string>()});
    for (const ordered_json& pair : json->at("options"))
      record.settings.push_back({pair.at(0).get<std::string>(), pair.at(1).get<std::string>()});
    record.pixels_sha256 = json->at("pixels").get<std::string>();
    // Settings are data from a file, and open no file that is not listed.
    for (const GivenSetting& one : record.settings)
      if (picture_option(one.id) == nullptr || names_file(one.id, one.value)) return damaged;
    for (const RecordedFile& file : record.files)
      if (file.option != kInputFile && !names_file(file.option, file.name)) return damaged;
    return record;
  } catch (const nlohmann::json::exception&) {
    return damaged;
  }
}

PictureRequest request_again(const PictureRecord& record, const std::string& folder, const std::string& input,
                             const Settings& changes) {
  PictureRequest request;
  request.input.input = !input.empty() ? input : record.built_in;
  const auto selection = first_selection(changes);
  const Settings of_all(changes.begin(), selection), of_selected(selection, changes.end());

  // Recorded actions after a selection stay; anything else gives way to a change.
  bool selected = false;
  const auto is_replaced = [&](const std::string& id) {
    return !(selected && is_action(id)) && std::any_of(of_all.begin(), of_all.end(), [&](const GivenSetting& change) {
      return replaces(change.id, id);
    });
  };
  const auto take_all = [&request](const Settings& settings) {
    for (const GivenSetting& one : settings) take_setting(request, one.id, one.value);
  };
  for (const RecordedFile& file : record.files)
    if (file.option == kInputFile) {
      if (request.input.input.empty()) request.input.input = found_file(file, folder);
    } else if (!is_replaced(file.option)) {
      take_setting(request, file.option, found_file(file, folder));
    }
  if (request.input.input.empty())
    fail_usage("the figure was drawn from spheres that came from no file", "name an input after the figure");
  take_all(of_all);
  for (const GivenSetting& one : record.settings) {
    selected = selected || one.id == "select";
    if (!is_replaced(one.id)) take_setting(request, one.id, one.value);
  }
  take_all(of_selected);
  return request;
}

std::vector<std::string> changed_files(const PictureRecord& record, const PictureRequest& request) {
  std::vector<std::string> changed;
  const auto path_of = [&request](const std::string& option) {
    if (option == kInputFile) return request.input.input;
    for (const GivenSetting& one : request.given)
      if (one.id == option) return one.value;
    return std::string();
  };
  for (const RecordedFile& file : record.files)
    if (sha256_at(path_of(file.option)) != file.sha256) changed.push_back(file.option);
  if (!record.built_in.empty() && request.input.input != record.built_in) changed.push_back(kInputFile);
  return changed;
}

}  // namespace bihive
