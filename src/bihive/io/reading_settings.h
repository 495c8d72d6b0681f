// The table of settings of reading: one row each, from which options with their help, the keywords of other languages,
// requests between programs, reports and refusals are made.
//
// To add a setting: a member of ReadOptions, a row in reading_settings.cpp, and the code that obeys it
// (io/assemble/finish.h).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Inputs that a control is shown for.
enum class ReadingOf { scenarios_and_files, files, molecules, frames, cells };

struct ReadingSetting {
  std::string_view id = "";           ///< "radius_scale"
  std::string_view value_name = "";   ///< of its value in help; empty: a flag
  std::string help = "";              ///< one sentence, without a full stop
  std::string_view inputs = "files";  ///< which have it, for messages
  /// Works where ranks read chunks of a file each; if not, one rank reads all of it.
  bool with_chunks = false;
  std::vector<std::string_view> excludes = {};  ///< ids of other settings
  std::string_view label = "";                  ///< of its control in the page; empty: it has none there
  std::string_view empty_means = "";            ///< in an empty control
  ReadingOf shown_for = ReadingOf::files;       ///< the inputs for which it has a control
  bool is_number = false;                       ///< from 0
  /// From the text of a command line; that of a flag is empty or "true". Error: the expected and the found text.
  Status (*take)(ReadOptions& options, const std::string& text) = nullptr;
  /// For reports: a key, and the value that `options` have, as JSON.
  std::string_view report = "";  ///< empty: `id`
  std::string (*value)(const ReadOptions& options) = nullptr;
};

std::span<const ReadingSetting> reading_settings();

/// The table, for what is generated from it in other languages.
std::string reading_settings_to_json();

/// The row of an id; null: none.
const ReadingSetting* reading_setting(std::string_view id);

/// The settings that somebody has given, and nothing else: that one is given is known, also where it changes nothing.
class GivenReading {
 public:
  /// Error: an unknown id, a setting given twice, one that another excludes, or a value out of range.
  Status take(std::string_view id, const std::string& text);
  /// The frame to read, in place of what was given; below 0: not given.
  void set_frame(std::int64_t frame);

  bool has(std::string_view id) const;
  const ReadOptions& options() const { return options_; }
  /// Ids and texts, in the order of the table.
  std::vector<std::pair<const ReadingSetting*, std::string>> all() const;

 private:
  ReadOptions options_;
  std::vector<std::pair<const ReadingSetting*, std::string>> given_;
};

/// An object with the text of each, and back. A number is taken for its text. Errors: no object; as
/// GivenReading::take().
std::string reading_to_json(const GivenReading& given);
Result<GivenReading> reading_from_json(std::string_view text);

}  // namespace bihive
