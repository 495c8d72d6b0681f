// The files named by a request's options, inputs and outputs. An option that names a file must be added here
// (tests/cli/request_files_test.py finds it from the description of the command line).
#pragma once

#include <string>
#include <vector>

#include "commands/commands.h"

namespace bihive::cli {

/// The files that a request reads, as far as its options name them; files that name more files (scenes) say so when
/// they are read (LoadedScene::files). Names that are not files, "-" and empty texts may be among them.
std::vector<std::string> inputs_of(const RenderOptions& options);
std::vector<std::string> inputs_of(const FilmOptions& options);
std::vector<std::string> inputs_of(const ViewOptions& options);
std::vector<std::string> inputs_of(const CompareOptions& options);
std::vector<std::string> inputs_of(const TraceOptions& options);
std::vector<std::string> inputs_of(const SceneSaveOptions& options);
std::vector<std::string> inputs_of(const MeasureCommandOptions& options);
std::vector<std::string> inputs_of(const ConvertOptions& options);
std::vector<std::string> inputs_of(const ThesisOptions& options);

/// The files that it writes; a film has more of them (film/film_sink.h).
std::vector<std::string> outputs_of(const RenderOptions& options);
std::vector<std::string> outputs_of(const ViewOptions& options);
std::vector<std::string> outputs_of(const CompareOptions& options);
std::vector<std::string> outputs_of(const TraceOptions& options);
std::vector<std::string> outputs_of(const SceneOptions& options);
std::vector<std::string> outputs_of(const SceneSaveOptions& options);
std::vector<std::string> outputs_of(const MeasureCommandOptions& options);
std::vector<std::string> outputs_of(const ConvertOptions& options);
std::vector<std::string> outputs_of(const ThesisOptions& options);

}  // namespace bihive::cli
