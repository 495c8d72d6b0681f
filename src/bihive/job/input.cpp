#include "bihive/job/input.h"

#include <unistd.h>

#include <filesystem>

#include "bihive/base/setting_name.h"
#include "bihive/base/write_file.h"
#include "bihive/io/data_path.h"
#include "bihive/io/packed.h"
#include "bihive/io/read_spheres.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/scene/load_spheres.h"

namespace bihive {
namespace {

void only_for(bool given, std::string_view id, const std::string& what, const std::string& input) {
  if (given) fail_setting(id, " is for " + what + ", not for " + input);
}

void refuse_generator_options(const InputOptions& options) {
  only_for(options.count.has_value(), "count", "scenario1, scenario2 and scenario3", options.input);
  only_for(options.seed.has_value(), "seed", "scenario1, scenario2 and scenario3", options.input);
}

void warn_of_growth(const std::string& path) {
  warn(path + ": grew while it was read; only its content at the time of opening is used");
}

// The size of a file when the object was made; 0 if it states none.
class FileSize {
 public:
  explicit FileSize(const std::string& path) : path_(path), size_(now()) {}
  bool grew() const { return now() > size_; }

 private:
  std::uintmax_t now() const {
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(path_, none);
    return none ? 0 : size;
  }

  std::string path_;
  std::uintmax_t size_;
};

}  // namespace

bool must_be_read_whole(const std::string& path) {
  std::error_code none;
  const std::string file = data_path(path).file;
  if (path == kStandardStream || !std::filesystem::is_regular_file(file, none)) return true;
  const Result<std::string> head = read_head(file);
  return head && looks_like_scene(*head);
}

bool is_generated(const std::string& name) {
  return is_built_in_scene(name) && name != "demo";
}

std::string read_input(const std::string& path) {
  bool grew = false;
  const std::string name = input_name(path);
  std::string bytes =
      value_or_fail(path == kStandardStream ? read_descriptor(STDIN_FILENO, name, &grew) : read_file(path, &grew));
  if (grew) warn_of_growth(name);
  return bytes;
}

std::string input_name(const std::string& path) {
  return path == kStandardStream ? "standard input" : path;
}

std::string file_of(const InputOptions& options) {
  return is_built_in_scene(options.input) || options.input == kStandardStream ? "" : data_path(options.input).file;
}

void check_input_options(const InputOptions& options) {
  if (!is_generated(options.input)) return refuse_generator_options(options);
  const bool is_scenario = options.input != "four-spheres";
  for (const auto& [row, text] : options.reading.all())
    only_for(!is_scenario || row->id != "radius", row->id, std::string(row->inputs), options.input);
  if (!is_scenario) refuse_generator_options(options);
}

void refuse_copies(const InputOptions& options, const std::string& what) {
  if (options.reading.has("replicate"))
    fail_usage(what + " without copies, so " + setting_name("replicate") + " changes nothing there", "leave it out");
}

void refuse_settings_of_files(const InputOptions& options) {
  const auto refuse = [](bool given, std::string_view id, const char* hint) {
    if (given) fail_setting(id, " is for files, and these spheres are in memory", hint);
  };
  refuse(options.count.has_value(), "count", "leave it out");
  refuse(options.seed.has_value(), "seed", "leave it out");
  for (const auto& [row, text] : options.reading.all())
    refuse(row->id != "frame" && row->id != "replicate" && row->id != "periodic" && row->id != "no_periodic", row->id,
           "give it where they are read");
}

std::optional<Scene> generated_scene(const InputOptions& options) {
  const std::string& name = options.input;
  if (!is_generated(name)) return std::nullopt;
  check_input_options(options);
  ScenarioParameters parameters;
  if (name != "four-spheres") {
    parameters.count = options.count.value_or(parameters.count);
    if (options.reading.has("radius")) parameters.radius = scenario_radius(*options.reading.options().radius);
    parameters.seed = options.seed.value_or(parameters.seed);
    value_or_fail(check_scenario_memory(parameters));
  }
  Result<LoadedScene> loaded = built_in_scene(name, parameters);
  if (!loaded) fail_usage(name + ": " + loaded.error().message, loaded.error().hint);
  return std::move(loaded->scene);
}

std::optional<Input> generated_input(const InputOptions& options) {
  std::optional<Scene> scene = generated_scene(options);
  if (!scene) return std::nullopt;
  Input input;
  input.scene = std::move(*scene);
  input.has_camera = true;
  input.has_lights = true;
  input.format = "built-in";
  return input;
}

void add_trajectory(const InputOptions& options, Input& input) {
  const std::string& trajectory = options.reading.options().trajectory;
  if (!trajectory.empty()) input.files.push_back(data_path(trajectory).file);
}

Input load_file(const InputOptions& options, const std::function<Result<Input>(const ReadOptions&)>& read) {
  check_input_options(options);
  const FileSize size(data_path(options.input).file);
  Input input = value_or_fail(read(options.reading.options()));
  if (size.grew()) warn_of_growth(options.input);
  add_trajectory(options, input);
  warn(input.warnings);
  return input;
}

Input load_input(const InputOptions& options, LooksOfFile looks, const Style* style, bool asked_for) {
  if (std::optional<Input> generated = generated_input(options)) {
    only_for(asked_for, "style", "files", options.input);
    return std::move(*generated);
  }
  if (options.input != "demo" && !must_be_read_whole(options.input))
    return load_file(options, [&](const ReadOptions& reading) { return load_spheres(options.input, reading, style); });
  check_input_options(options);
  const ReadOptions& reading = options.reading.options();
  const auto load = [&]() -> Result<Input> {
    if (options.input == "demo") return built_in_scene("demo", {}, reading, style);
    const std::string name = input_name(options.input);
    const std::string bytes = value_or_fail(unpack_if_packed(read_input(options.input), name));
    return load_scene(bytes, name, reading, looks, asked_for || !looks_like_scene(bytes) ? style : nullptr);
  };
  Input input = value_or_fail(load());
  add_trajectory(options, input);
  warn(input.warnings);
  return input;
}

}  // namespace bihive
