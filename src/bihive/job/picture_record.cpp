#include "bihive/job/picture_record.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bihive/base/json_text.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/sha256.h"
#include "bihive/base/version.h"
#include "bihive/io/bundled.h"
#include "bihive/io/data_path.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/fixed_json.h"
#include "bihive/job/merge_settings.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/report_text.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;
using Settings = std::vector<GivenSetting>;

// Pictures of films, and films, came with the second version: the first one would draw them with another camera.
constexpr int kRecordVersion = 1, kRecordVersionOfFilms = 2;

// Settings that change no pixel: all engines of the CPU and all their trees give the same bits.
bool changes_nothing(const GivenSetting& setting, View view) {
  const bool shows_tree = view == View::traversal || view == View::tree;
  return setting.id == "threads" || setting.id == "tune" ||
         (setting.id == "engine" && !setting.value.starts_with("gpu")) ||
         ((setting.id == "max_prims" || setting.id == "max_depth") && !shows_tree);
}

// Empty if the file cannot be read.
std::string sha256_at(const std::string& path) {
  const Result<std::string> digits = sha256_of_file(data_path(path).file);
  return digits ? *digits : "";
}

// The bytes of an input: those of the bundled molecule have a name too.
constexpr const char* kBundled = "demo";

std::string sha256_of_input(const std::string& input) {
  if (input != kBundled) return sha256_at(input);
  Sha256 digest;
  digest.add(bundled_molecule());
  return digest.digits();
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

ordered_json pairs(const Settings& settings) {
  ordered_json json = ordered_json::array();
  for (const GivenSetting& one : settings) json.push_back({one.id, one.value});
  return json;
}

}  // namespace

std::string without_folder(const std::string& path) {
  return path.substr(data_path(path).file.rfind('/') + 1);  // npos + 1 is 0
}

std::vector<RecordedFile> files_of_record(const PictureRequest& request) {
  std::vector<RecordedFile> files;
  const std::string& input = request.input.input;
  if (!is_built_in_scene(input) && !input.empty() && input != kStandardStream)
    files.push_back(recorded_file(kInputFile, input));
  for (const GivenSetting& one : ordered_settings(request))
    if (names_file(one.id, one.value)) files.push_back(recorded_file(one.id, one.value));
  return files;
}

PictureRecord record_of(const PictureRequest& request, const std::vector<RecordedFile>& files,
                        std::string pixels_sha256) {
  PictureRecord record{std::string(version()), std::string(commit()), "", files, {}, {}, std::move(pixels_sha256)};
  if (is_built_in_scene(request.input.input)) record.built_in = request.input.input;
  if (request.fixed) {
    record.fixed = request.fixed;
    record.frame = request.input.reading.options().frame;
  }
  for (GivenSetting& one : ordered_settings(request))
    if (!changes_nothing(one, request.view) && !names_file(one.id, one.value) && !(request.fixed && one.id == "frame"))
      record.settings.push_back(std::move(one));
  return record;
}

PictureRecord record_of(const PictureRequest& request, std::string pixels_sha256) {
  return record_of(request, files_of_record(request), std::move(pixels_sha256));
}

void ChannelsHash::add(const std::vector<Channel>& rows, int width) {
  std::vector<const Channel*> sorted;
  for (const Channel& channel : rows) sorted.push_back(&channel);
  std::sort(sorted.begin(), sorted.end(), [](const Channel* a, const Channel* b) { return a->name < b->name; });
  const auto size = static_cast<std::size_t>(width);
  const Channel& first = *sorted.front();
  const std::size_t count = (first.of_ids ? first.ids.size() : first.numbers.size()) / size;
  for (std::size_t y = 0; y < count; ++y)
    for (const Channel* const channel : sorted) {
      const void* const numbers = channel->of_ids ? static_cast<const void*>(channel->ids.data() + y * size)
                                                  : static_cast<const void*>(channel->numbers.data() + y * size);
      sha_.add({static_cast<const char*>(numbers), size * sizeof(float)});
    }
}

std::string to_text(const PictureRecord& record) {
  const bool is_of_film = record.fixed || !record.film.empty();
  ordered_json json{{"record", is_of_film ? kRecordVersionOfFilms : kRecordVersion}, {"version", record.version}};
  if (!record.commit.empty()) json["commit"] = record.commit;
  if (!record.built_in.empty()) json["scene"] = record.built_in;
  json["files"] = ordered_json::array();
  for (const RecordedFile& file : record.files)
    json["files"].push_back({{"option", file.option}, {"name", file.name}, {"sha256", file.sha256}});
  json["options"] = pairs(record.settings);
  if (!record.layers.empty()) json["layers"] = record.layers;
  if (record.fixed) {
    json["frame"] = record.frame;
    json["fixed"] = fixed_json(*record.fixed);
  }
  if (record.film.empty()) {
    json["pixels"] = record.pixels_sha256;
  } else {
    json["film"] = *json_from_text<ordered_json>(record.film);
    json["pictures"] = record.pictures_sha256;
  }
  return as_text(json, -1);
}

std::string to_text_with_settings(const PictureRecord& record, const std::string& settings) {
  std::string text = to_text(record);
  if (settings.empty()) return text;
  text.pop_back();
  return text + ",\"settings\":" + settings + "}";
}

Result<PictureRecord> picture_record_from(std::string_view text) {
  const Error damaged{"its record of how it was drawn is damaged", "", 0, 0, ""};
  const Result<ordered_json> json = json_from_text<ordered_json>(text);
  if (!json || !json->is_object() || !json->contains("record")) return damaged;
  try {
    if (json->at("record").get<int>() > kRecordVersionOfFilms)
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
    record.layers = json->value("layers", record.layers);
    if (json->contains("fixed")) {
      record.fixed = fixed_by_film_of(json->at("fixed"));
      record.frame = std::max<std::int64_t>(0, json->at("frame").get<std::int64_t>());
    }
    if (json->contains("film")) {
      record.film = as_text(json->at("film"), -1);
      record.pictures_sha256 = json->at("pictures").get<std::vector<std::string>>();
    } else {
      record.pixels_sha256 = json->at("pixels").get<std::string>();
    }
    // Settings are data from a file, and open no file that is not listed.
    for (const GivenSetting& one : record.settings)
      if (picture_option(one.id) == nullptr || names_file(one.id, one.value)) return damaged;
    for (const RecordedFile& file : record.files)
      if (file.option != kInputFile && !names_file(file.option, file.name)) return damaged;
    return record;
  } catch (const nlohmann::json::exception&) {
    return damaged;
  } catch (const std::out_of_range&) {
    return damaged;
  }
}

PictureRequest request_again(const PictureRecord& record, const std::string& folder, const std::string& input,
                             const Settings& changes) {
  PictureRequest request;
  request.input.input = !input.empty() ? input : record.built_in;
  if (record.fixed)
    for (const GivenSetting& one : changes)
      if (picture_option(one.id)->theme == OptionTheme::camera)
        fail_setting(one.id, " changes the camera, and this picture of a film has that of the film",
                     "draw a picture of the input by bihive render");
  Settings kept;
  for (const RecordedFile& file : record.files)
    if (file.option != kInputFile)
      kept.push_back({file.option, file.name});
    else if (request.input.input.empty())
      request.input.input = found_file(file, folder);
  if (request.input.input.empty())
    fail_usage("the figure was drawn from spheres that came from no file", "name an input after the figure");
  kept.insert(kept.end(), record.settings.begin(), record.settings.end());
  merge_settings(request, kept, changes, [&](const GivenSetting& one) {
    if (!names_file(one.id, one.value)) return one.value;
    const auto file = std::find_if(record.files.begin(), record.files.end(), [&one](const RecordedFile& recorded) {
      return recorded.option == one.id && recorded.name == one.value;
    });
    return found_file(*file, folder);
  });
  request.fixed = record.fixed;
  if (record.fixed && !is_generated(request.input.input) && !request.input.reading.has("frame"))
    request.input.reading.set_frame(record.frame);
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
    if (sha256_of_input(path_of(file.option)) != file.sha256) changed.push_back(file.option);
  const std::string& input = request.input.input;
  const bool is_same =
      input == record.built_in || (record.built_in == kBundled && sha256_of_input(input) == sha256_of_input(kBundled));
  if (!record.built_in.empty() && !is_same) changed.push_back(kInputFile);
  return changed;
}

}  // namespace bihive
