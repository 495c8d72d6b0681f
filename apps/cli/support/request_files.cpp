#include "support/request_files.h"

#include "bihive/io/data_path.h"
#include "bihive/job/picture_options.h"

namespace bihive::cli {
namespace {

using Files = std::vector<std::string>;

Files together(std::initializer_list<Files> lists) {
  Files all;
  for (const Files& files : lists) all.insert(all.end(), files.begin(), files.end());
  return all;
}

// For commands whose options are not those of a picture.
Files files_of(const InputOptions& input) {
  return {file_of(input), data_path(input.reading.options().trajectory).file};
}

// The options shared by commands that draw.
template <class Options>
Files files_of_drawing(const Options& options) {
  Files files{file_of(options.input)};
  for (const GivenSetting& named : files_named_by(options)) files.push_back(data_path(named.value).file);
  return files;
}

}  // namespace

Files inputs_of(const RenderOptions& options) {
  return together({files_of_drawing(options), {options.film}});
}

Files inputs_of(const FilmOptions& options) {
  return together({inputs_of(options.picture), {options.camera_keys}});
}

Files inputs_of(const ViewOptions& options) {
  return files_of_drawing(options);
}

Files inputs_of(const CompareOptions& options) {
  return files_of(options.input);
}

Files inputs_of(const TraceOptions& options) {
  return together({files_of(options.input), {options.rays}});
}

Files inputs_of(const SceneSaveOptions& options) {
  return inputs_of(options.picture);
}

Files inputs_of(const MeasureCommandOptions& options) {
  return files_of(options.input);
}

Files inputs_of(const ConvertOptions& options) {
  return files_of(options.input);
}

Files inputs_of(const ThesisOptions& options) {
  return options.devices;
}

Files outputs_of(const RenderOptions& options) {
  return {options.output};
}

Files outputs_of(const ViewOptions& options) {
  return options.screenshot.empty() ? Files{} : Files{options.screenshot};
}

Files outputs_of(const CompareOptions& options) {
  return options.output.empty() ? Files{} : Files{options.output};
}

Files outputs_of(const TraceOptions& options) {
  return {options.t, options.id};
}

Files outputs_of(const SceneOptions& options) {
  return {options.output};
}

Files outputs_of(const SceneSaveOptions& options) {
  return outputs_of(options.picture);
}

Files outputs_of(const MeasureCommandOptions& options) {
  Files files;
  for (const std::string& file : {options.per_sphere, options.cavities, options.contacts, options.buried})
    if (!file.empty()) files.push_back(file);
  return files;
}

Files outputs_of(const ConvertOptions& options) {
  return {options.output};
}

Files outputs_of(const ThesisOptions& options) {
  if (!options.page.empty()) return {options.page};
  return {options.out + "/report.html", options.out + "/results.json"};
}

}  // namespace bihive::cli
