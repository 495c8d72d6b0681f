// The values of the options of `bihive film`, from their texts.

#include <cstddef>

#include "bihive/base/parse_number.h"
#include "commands/commands.h"

namespace bihive::cli {
namespace {

constexpr std::int64_t kMostOfRate = 1'000'000;

Error rate_error(const std::string& text) {
  return unexpected("pictures per second, a number from 0.001 to 1000000 such as 25, 29.97 or 30000/1001", text);
}

}  // namespace

Result<FrameRate> frame_rate_from(const std::string& text) {
  const std::size_t slash = text.find('/'), point = text.find('.');
  if (slash != std::string::npos) {
    const Result<std::int64_t> pictures = whole_number_from_text(text.substr(0, slash), 1, kMostOfRate);
    const Result<std::int64_t> seconds = whole_number_from_text(text.substr(slash + 1), 1, kMostOfRate);
    if (!pictures || !seconds) return rate_error(text);
    return FrameRate{*pictures, *seconds};
  }
  // "29.97" is 2997/100.
  constexpr std::size_t kMostDecimals = 3;
  std::string digits = text;
  std::int64_t scale = 1;
  if (point != std::string::npos) {
    const std::size_t decimals = text.size() - point - 1;
    if (point == 0 || decimals < 1 || decimals > kMostDecimals) return rate_error(text);
    digits.erase(point, 1);
    for (std::size_t i = 0; i < decimals; ++i) scale *= 10;
  }
  const Result<std::int64_t> pictures = whole_number_from_text(digits, 1, kMostOfRate * scale);
  if (!pictures) return rate_error(text);
  return FrameRate{*pictures, scale};
}

Result<Shard> shard_from(const std::string& text) {
  constexpr std::int64_t kMostShards = 1'000'000;
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const Result<std::int64_t> index = whole_number_from_text(text.substr(0, slash), 0, kMostShards);
    const Result<std::int64_t> count = whole_number_from_text(text.substr(slash + 1), 1, kMostShards);
    if (index && count && *index < *count) return Shard{*index, *count};
  }
  return unexpected("i/N with i from 0 to N - 1", text);
}

}  // namespace bihive::cli
