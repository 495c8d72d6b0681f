#include "bihive/scene/frame_range.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "bihive/base/parse_number.h"

namespace bihive {
namespace {

// More frames than any trajectory has; sums of two such numbers do not overflow.
constexpr std::int64_t kMostFrames = std::int64_t{1} << 60;

std::optional<std::int64_t> whole_number(const std::string& text) {
  const bool negative = !text.empty() && text.front() == '-';
  std::int64_t value = 0;
  if (text.size() == (negative ? 1U : 0U)) return std::nullopt;
  for (std::size_t i = negative ? 1 : 0; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9' || value > kMostFrames / 10) return std::nullopt;
    value = 10 * value + (text[i] - '0');
  }
  return negative ? -value : value;
}

Error range_error(const std::string& text) {
  return unexpected("frames as A:B:STEP or A:B, or one frame", text,
                    "0:500:5 is every fifth of the first 500 frames, :: all");
}

}  // namespace

Result<FrameRange> frame_range_from_text(const std::string& text) {
  // Cut the text at its colons.
  std::array<std::string, 3> parts;
  std::size_t colons = 0;
  for (const char c : text) {
    if (c == ':' && ++colons == parts.size()) return range_error(text);
    if (c != ':') parts[colons] += c;
  }
  std::array<std::optional<std::int64_t>, 3> numbers;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    numbers[i] = whole_number(parts[i]);
    if (!parts[i].empty() && !numbers[i]) return range_error(text);
  }
  FrameRange range;
  range.begin = numbers[0].value_or(0);
  if (colons == 0) {
    if (!numbers[0]) return range_error(text);
    // The frame after the last one has no number from the end.
    if (range.begin != -1) range.end = range.begin + 1;
    return range;
  }
  range.end = numbers[1];
  range.step = numbers[2].value_or(1);
  if (range.step < 1) return range_error(text);
  return range;
}

std::optional<std::int64_t> FrameList::picture_of(std::int64_t wanted) const {
  const std::int64_t steps = (wanted - first) / step;
  if (wanted < first || steps >= count || frame(steps) != wanted) return std::nullopt;
  return steps;
}

Result<FrameList> frames_in(const FrameRange& range, std::int64_t frames) {
  const std::int64_t begin = range.begin < 0 ? range.begin + frames : range.begin;
  std::int64_t end = range.end.value_or(frames);
  if (end < 0) end += frames;
  end = std::min(end, frames);
  if (begin < 0 || begin >= end)
    return Error{"there is no such frame: the file has " + std::to_string(frames) +
                     (frames == 1 ? " frame, number 0" : " frames, 0 to " + std::to_string(frames - 1)),
                 "", 0, 0, ""};
  return FrameList{begin, range.step, (end - begin + range.step - 1) / range.step};
}

}  // namespace bihive
