// INPUT of every sub-command: a built-in name, a scene file or a file of spheres.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bihive/bih/tree.h"
#include "bihive/io/reading_settings.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/load_scene.h"

namespace bihive {

/// Stands for the standard input and the standard output.
inline const std::string kStandardStream = "-";

/// The input and its options; unset if not given.
struct InputOptions {
  std::string input;
  std::optional<std::int64_t> count;
  std::optional<std::uint64_t> seed;
  GivenReading reading;
};

/// The bytes of a file, or of the standard input for "-". Warns if the file grew meanwhile. Fails with kBadInput.
std::string read_input(const std::string& path);

/// The name of that file in messages: "standard input" for "-".
std::string input_name(const std::string& path);

/// The path of the input's file; empty for the names of built-in scenes and the standard input.
std::string file_of(const InputOptions& options);

/// Fails with kBadUsage if --replicate is given, for commands that use the stored spheres alone. `what`: what they do.
void refuse_copies(const InputOptions& options, const std::string& what);

/// Fails with kBadUsage on a setting that is for files, when the spheres are in memory already; `frame` (for titles),
/// `replicate` and `periodic` are not among them.
void refuse_settings_of_files(const InputOptions& options);

/// Coloured, at least one sphere; its warnings were already printed on stderr.
using Input = LoadedScene;

/// Fails with kBadUsage on options that do not fit the input.
void check_input_options(const InputOptions& options);

/// "-" is the standard input. Built-in names come first: scenario1, scenario2, scenario3, four-spheres, demo. Prints
/// warnings on stderr. Fails with kBadUsage on options that do not fit the input, and with kBadInput on an unreadable
/// file. `style`: the appearance of spheres without their own; null: plain. `asked_for`: scene files use it for missing
/// values too, and the thesis's scenes, which miss none, refuse it.
Input load_input(const InputOptions& options, LooksOfFile looks = LooksOfFile::apply, const Style* style = nullptr,
                 bool asked_for = false);

/// The same for a file on the disk that `read` reads. It need not be read whole.
Input load_file(const InputOptions& options, const std::function<Result<Input>(const ReadOptions&)>& read);

/// Notes the trajectory among the input's files.
void add_trajectory(const InputOptions& options, Input& input);

/// Made by the program, not read: scenario1, scenario2, scenario3, four-spheres.
bool is_generated(const std::string& name);

/// Whether the input must be in memory as a whole: a scene, or not a plain file, which can be read only once.
bool must_be_read_whole(const std::string& path);

/// The scene of a name of `bihive scene`: scenario1, scenario2, scenario3 or four-spheres; nothing for other names.
std::optional<Scene> generated_scene(const InputOptions& options);
/// The same as an input, with its camera and lights.
std::optional<Input> generated_input(const InputOptions& options);

}  // namespace bihive
