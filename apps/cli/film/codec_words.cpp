#include "film/codec_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "bihive/base/ascii.h"
#include "bihive/base/readable.h"
#include "bihive/base/setting_name.h"

namespace bihive::cli {
namespace {

// No value of these names a file, whatever it is. Options of a codec that take a list (-x264-params) may name files in
// it.
constexpr std::string_view kWithValue[] = {"-b:v",
                                           "-bf",
                                           "-bufsize",
                                           "-c:v",
                                           "-codec:v",
                                           "-coder",
                                           "-color_primaries",
                                           "-color_range",
                                           "-color_trc",
                                           "-colorspace",
                                           "-compression_level",
                                           "-context",
                                           "-cpu-used",
                                           "-crf",
                                           "-deadline",
                                           "-g",
                                           "-keyint_min",
                                           "-level",
                                           "-level:v",
                                           "-lossless",
                                           "-maxrate",
                                           "-minrate",
                                           "-movflags",
                                           "-pix_fmt",
                                           "-pred",
                                           "-preset",
                                           "-profile:v",
                                           "-q:v",
                                           "-qmax",
                                           "-qmin",
                                           "-qp",
                                           "-qscale:v",
                                           "-quality",
                                           "-refs",
                                           "-row-mt",
                                           "-sc_threshold",
                                           "-slicecrc",
                                           "-slices",
                                           "-tag:v",
                                           "-threads",
                                           "-tile-columns",
                                           "-tile-rows",
                                           "-tune",
                                           "-vcodec"};
constexpr std::size_t kLongestValue = 40;

template <std::size_t Count>
bool is_in(const std::string_view (&list)[Count], std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

bool is_plain_value(std::string_view word) {
  if (word.empty() || word.size() > kLongestValue) return false;
  // "-1" is a number, and "+faststart" a flag.
  const bool is_number = word.size() > 1 && word[0] == '-' && is_digit(word[1]);
  if (!is_number && word[0] != '+' && !is_letter_or_digit(word[0])) return false;
  return std::all_of(word.begin() + 1, word.end(), [](char c) {
    return is_letter_or_digit(c) || std::string_view("_+-.").find(c) != std::string_view::npos;
  });
}

}  // namespace

std::vector<std::string> codec_words(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text)
    if (c == ' ')
      words.emplace_back();
    else
      words.back() += c;
  words.erase(std::remove(words.begin(), words.end(), std::string()), words.end());
  return words;
}

// Sides are even for H.264 with halved colours; the colours are those of screens.
std::vector<std::string> default_codec(const std::string& ending, int width_px, int height_px) {
  std::string filter = "scale=out_color_matrix=bt709:out_range=tv";
  // The last column and row again, where one more is needed.
  if (width_px % 2 != 0 || height_px % 2 != 0)
    filter = fmt::format("pad=ceil(iw/2)*2:ceil(ih/2)*2,fillborders=right={}:bottom={}:mode=smear,{}", width_px % 2,
                         height_px % 2, filter);
  std::vector<std::string> words{"-vf", filter};
  const std::vector<std::string> codec =
      codec_words(ending == ".webm" ? "-c:v libvpx-vp9 -crf 24 -b:v 0 -row-mt 1" : "-c:v libx264 -crf 18");
  words.insert(words.end(), codec.begin(), codec.end());
  for (const char* word : {"-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc",
                           "bt709", "-color_range", "tv"})
    words.emplace_back(word);
  return words;
}

Status check_codec_of_file(const std::string& text) {
  const std::vector<std::string> words = codec_words(text);
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const auto refuse = [&](const std::string& what) -> Status {
      return Error{"the codec contains " + masked(what) + ", which is not allowed in a file", "", 0, 0,
                   "if it is your own, give the same " + setting_name("codec") + " on the command line too"};
    };
    if (!is_in(kWithValue, words[i])) return refuse(words[i]);
    if (i + 1 == words.size()) return refuse(words[i] + " without a value");
    if (!is_plain_value(words[i + 1])) return refuse(words[i] + " " + words[i + 1]);
  }
  return Done{};
}

}  // namespace bihive::cli
