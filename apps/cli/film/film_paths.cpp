#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "bihive/job/failure.h"
#include "film/film_sink.h"

namespace bihive::cli {
namespace {

std::string lower_ending(const std::string& output) {
  const std::size_t dot = output.rfind('.');
  if (dot == std::string::npos || output.find('/', dot) != std::string::npos) return "";
  std::string ending = output.substr(dot);
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

// The position of the number in the name of a sequence: "%05d" or "%d".
struct NumberPlace {
  std::size_t begin = 0, size = 0;
  int digits = 0;
};

// Fails with kBadUsage unless there is exactly one, after the last '/'.
NumberPlace number_place(const std::string& pattern) {
  constexpr std::size_t kMostDigits = 2;
  const auto wrong = [&] {
    fail_usage("a sequence of pictures has one place for their number in its name, found \"" + pattern + "\"",
               "name it run/%05d.png");
  };
  NumberPlace place;
  place.begin = pattern.find('%');
  if (place.begin == std::string::npos || pattern.find('%', place.begin + 1) != std::string::npos) wrong();
  if (pattern.find('/', place.begin) != std::string::npos) wrong();
  std::size_t at = place.begin + 1;
  const std::size_t digits_at = at;
  while (at < pattern.size() && pattern[at] >= '0' && pattern[at] <= '9') {
    place.digits = 10 * place.digits + (pattern[at] - '0');
    ++at;
  }
  if (at >= pattern.size() || pattern[at] != 'd' || at - digits_at > kMostDigits) wrong();
  if (at > digits_at && pattern[digits_at] != '0') wrong();
  place.size = at + 1 - place.begin;
  return place;
}

}  // namespace

FilmKind film_kind(const std::string& output) {
  const std::string ending = lower_ending(output);
  if (ending == ".png") {
    number_place(output);
    return FilmKind::pictures;
  }
  if (ending == ".y4m") return FilmKind::y4m;
  for (const char* known : {".mp4", ".mov", ".mkv", ".webm"})
    if (ending == known) return FilmKind::encoded;
  fail_usage(
      "a film ends in .mp4, .mov, .mkv, .webm or .y4m, or is a sequence such as run/%05d.png; found \"" + output + "\"",
      "choose one of these endings");
}

void check_link_of_film(const std::string& link, const std::string& film) {
  const std::string ending = lower_ending(link);
  if (ending != lower_ending(film))
    fail_usage("the link " + link + " leads to " + film + ", which does not end in " + ending,
               "let both end alike, or name the file itself");
}

std::string plan_path(const std::string& output) {
  if (film_kind(output) != FilmKind::pictures) return output + ".json";
  return output.substr(0, number_place(output).begin) + "film.json";
}

std::string picture_path(const std::string& pattern, std::int64_t number) {
  const NumberPlace place = number_place(pattern);
  return pattern.substr(0, place.begin) + fmt::format("{:0{}}", number, place.digits) +
         pattern.substr(place.begin + place.size);
}

std::string part_path(const std::string& output) {
  return output + ".part";
}

std::string shard_picture_path(const std::string& output, std::int64_t number) {
  return part_path(output) + fmt::format("/picture-{:08}.png", number);
}

}  // namespace bihive::cli
