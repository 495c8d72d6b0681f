#include "film/film_outputs.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "bihive/base/place_file.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "film/film_sink.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

namespace fs = std::filesystem;

// The file of a sequence that is this input too; empty if none is. Its number is in the input's name.
std::string picture_that_is(const std::string& input, const std::string& pattern) {
  constexpr const char* kDigits = "0123456789";
  constexpr std::size_t kMostDigits = 18;
  std::error_code code;
  const fs::path file = fs::canonical(input, code);
  if (code || !fs::is_regular_file(file, code)) return "";
  const std::string name = file.filename().string();
  for (std::size_t at = 0; (at = name.find_first_of(kDigits, at)) != std::string::npos;) {
    const std::size_t end = std::min(name.find_first_not_of(kDigits, at), name.size());
    if (end - at > kMostDigits) return "";
    const std::string picture = picture_path(pattern, std::stoll(name.substr(at, end - at)));
    if (is_same_file(picture, input)) return picture;
    at = end;
  }
  return "";
}

void check_parts(const std::string& output, const std::vector<std::string>& inputs) {
  std::error_code unknown;
  const std::string parts = part_path(fs::weakly_canonical(output, unknown).string());
  for (const std::string& input : inputs)
    if (!input.empty() && fs::equivalent(fs::weakly_canonical(input, unknown).parent_path(), parts, unknown))
      fail({"lies in the folder of the film's parts, which goes away", input, 0, 0, "move it, or name another output"});
}

}  // namespace

void check_film_outputs(const std::string& output, const std::vector<std::string>& inputs) {
  const std::string described = plan_path(output);
  if (film_kind(output) != FilmKind::pictures) {
    check_parts(output, inputs);
    check_outputs({output, described}, inputs);
    if (is_stream(output))
      fail_usage("a film is made in a folder beside it, so " + output + " cannot hold it", "name a file");
    return;
  }
  for (const std::string& input : inputs)
    if (const std::string picture = picture_that_is(input, output); !picture.empty())
      fail({"is the input " + input + " too, and writing it would destroy that", picture, 0, 0, "name another output"});
  // The folder of a sequence is made if it is missing.
  const fs::path folder = fs::path(described).parent_path();
  std::error_code code;
  if (folder.empty() || fs::exists(folder, code))
    check_outputs({described}, inputs);
  else
    value_or_fail(path_behind_links(folder.string()));
}

}  // namespace bihive::cli
