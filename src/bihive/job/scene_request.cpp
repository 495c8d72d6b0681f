#include "bihive/job/scene_request.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bihive/base/path_parts.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/data_path.h"
#include "bihive/io/packed.h"
#include "bihive/job/failure.h"
#include "bihive/job/merge_settings.h"
#include "bihive/job/picture_options.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/saved_request.h"

namespace bihive {
namespace {

namespace fs = std::filesystem;

// A document that refers to itself, or to a long chain of others, is none.
constexpr int kMostDocuments = 8;

// A path for a document in this folder.
std::string seen_from(const std::string& folder, const std::string& path) {
  if (fs::path(path).is_absolute()) return path;
  std::error_code none;
  const fs::path whole = fs::weakly_canonical(folder, none);
  const fs::path there =
      fs::weakly_canonical(fs::path(path).parent_path().empty() ? "." : fs::path(path).parent_path(), none);
  const fs::path relative = there.lexically_relative(whole);
  if (relative.empty()) return fs::absolute(path, none).string();
  return (relative == "." ? fs::path() : relative / "").string() + fs::path(path).filename().string();
}

std::string beside(const std::string& document, const std::string& path) {
  const std::size_t slash = document.rfind('/');
  if (fs::path(path).is_absolute() || slash == std::string::npos) return path;
  const std::string whole = document.substr(0, slash + 1) + path;
  // Without "..", unless that leads elsewhere through a link.
  const std::string shorter = fs::path(whole).lexically_normal().string();
  std::error_code none;
  return fs::equivalent(data_path(whole).file, data_path(shorter).file, none) ? shorter : whole;
}

// Documents that can be read once are read by whom they are for.
std::optional<SavedRequest> request_in(const std::string& path) {
  std::error_code none;
  if (is_built_in_scene(path) || path == kStandardStream || !fs::is_regular_file(path, none) ||
      !must_be_read_whole(path))
    return std::nullopt;
  return value_or_fail(saved_request_from(value_or_fail(unpack_if_packed(read_input(path), path)), path));
}

}  // namespace

std::string scene_of_request(const PictureRequest& request, const std::string& path) {
  const std::string& input = request.input.input;
  if (input.empty() || input == kStandardStream)
    fail_usage("a scene file names its input, and the standard input has no name", "write it into a file first");
  const std::string folder = folder_of(path);
  SavedRequest saved{is_built_in_scene(input) ? input : seen_from(folder, input), {}};
  for (GivenSetting& one : ordered_settings(request))
    saved.options.emplace_back(one.id, names_file(one.id, one.value) ? seen_from(folder, one.value) : one.value);
  return to_scene_json(saved);
}

bool take_saved_request(PictureRequest& request, const std::function<bool(const std::string& id)>& takes) {
  for (int documents = 0;; ++documents) {
    const std::string document = request.input.input;
    const std::optional<SavedRequest> saved = request_in(document);
    if (!saved) return documents > 0;
    if (documents == kMostDocuments)
      fail({"its input is a scene file with an input of its own, again and again", document, 0, 0, ""});
    std::vector<GivenSetting> settings;
    for (const auto& [id, value] : saved->options) {
      if (takes && !takes(id)) continue;
      if (id == "colour_by" && names_file(id, value))
        fail({"names a file of colours (" + value + "), and a scene file holds the colours themselves", document, 0, 0,
              "bihive scene save writes them"});
      settings.push_back({id, names_file(id, value) ? beside(document, value) : value});
    }
    PictureRequest merged;
    merged.input.input = is_built_in_scene(saved->input) ? saved->input : beside(document, saved->input);
    merged.fixed = request.fixed;
    merge_settings(merged, settings, request.given);
    request = std::move(merged);
  }
}

void take_saved_input(InputOptions& input, TreeParameters* tree) {
  PictureRequest request;
  request.input.input = input.input;
  const auto give = [&request](const std::string& id, const std::string& value) {
    request.given.push_back({id, value});
  };
  if (input.count) give("count", std::to_string(*input.count));
  if (input.seed) give("seed", std::to_string(*input.seed));
  for (const auto& [row, text] : input.reading.all()) give(std::string(row->id), text);
  if (!take_saved_request(request)) return;
  input = request.input;
  if (tree == nullptr) return;
  if (!tree->max_prims) tree->max_prims = request.tree.max_prims;
  if (!tree->max_depth) tree->max_depth = request.tree.max_depth;
}

}  // namespace bihive
