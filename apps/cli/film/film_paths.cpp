#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "bihive/base/path_parts.h"
#include "bihive/job/failure.h"
#include "film/film_sink.h"

namespace bihive::cli {
namespace {

// The path of a picture of a sequence, split at its number, and the minimum number of digits.
struct SequencePaths {
  std::string before, after;
  int digits = 0;
};

// The number is "%05d" or "%d" in the file's name, and "%%" there is a percent sign. Folders are literal. Fails with
// kBadUsage unless there is exactly one number.
SequencePaths sequence_paths(const std::string& pattern) {
  constexpr std::size_t kMostDigits = 2;
  const auto wrong = [&] {
    fail_usage("the name of each picture of a sequence has its number in one place, found \"" + pattern + "\"",
               "name it run/%05d.png; a percent sign in the file's name is %%");
  };
  const std::size_t name = pattern.rfind('/') + 1;  // 0 without a folder
  SequencePaths paths;
  paths.before = pattern.substr(0, name);
  bool has_number = false;
  for (std::size_t at = name; at < pattern.size(); ++at) {
    std::string& part = has_number ? paths.after : paths.before;
    if (pattern[at] != '%') {
      part += pattern[at];
      continue;
    }
    if (pattern.compare(at, 2, "%%") == 0) {
      part += '%';
      ++at;
      continue;
    }
    const std::size_t digits = at + 1, end = pattern.find_first_not_of("0123456789", digits);
    if (has_number || end == std::string::npos || pattern[end] != 'd' || end - digits > kMostDigits) wrong();
    if (end > digits && pattern[digits] != '0') wrong();
    if (end > digits) paths.digits = std::stoi(pattern.substr(digits, end - digits));
    has_number = true;
    at = end;
  }
  if (!has_number) wrong();
  return paths;
}

}  // namespace

FilmKind film_kind(const std::string& output) {
  const std::string ending = ending_of(output);
  if (ending == ".png") {
    sequence_paths(output);
    return FilmKind::pictures;
  }
  if (ending == ".y4m") return FilmKind::y4m;
  for (const char* known : {".mp4", ".mov", ".mkv", ".webm", ".gif", ".apng"})
    if (ending == known) return FilmKind::encoded;
  fail_usage(
      "a film ends in .mp4, .mov, .mkv, .webm, .gif, .apng or .y4m, or is a sequence such as run/%05d.png; found \"" +
          output + "\"",
      "choose one of these endings");
}

bool is_animation(const std::string& output) {
  const std::string ending = ending_of(output);
  return ending == ".gif" || ending == ".apng";
}

void check_link_of_film(const std::string& link, const std::string& film) {
  const std::string ending = ending_of(link);
  if (ending != ending_of(film))
    fail_usage("the link " + link + " leads to " + film + ", which does not end in " + ending,
               "let both end alike, or name the file itself");
}

std::string plan_path(const std::string& output) {
  if (film_kind(output) != FilmKind::pictures) return output + ".json";
  return sequence_paths(output).before + "film.json";
}

std::string picture_path(const std::string& pattern, std::int64_t number) {
  const SequencePaths paths = sequence_paths(pattern);
  return paths.before + fmt::format("{:0{}}", number, paths.digits) + paths.after;
}

std::string part_path(const std::string& output) {
  return output + ".part";
}

std::string shard_picture_path(const std::string& output, std::int64_t number) {
  return part_path(output) + fmt::format("/picture-{:08}.png", number);
}

}  // namespace bihive::cli
