#include "bihive/base/parse_number.h"

#include <fmt/format.h>
#include <gemmi/third_party/fast_float.h>

#include <charconv>
#include <string>

namespace bihive {
namespace {

// A number may have a leading plus sign, but not another sign after it.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

// Fortran's exponents: 1.0D+03. A whole number needs the exponent's sign: else 4D12 is a name.
std::optional<std::string> with_e(std::string_view text) {
  const std::size_t at = text.find_first_of("dD");
  if (at == 0 || at == std::string_view::npos || at + 1 == text.size()) return std::nullopt;
  const bool is_signed = text[at + 1] == '+' || text[at + 1] == '-';
  if (!is_signed && text.substr(0, at).find('.') == std::string_view::npos) return std::nullopt;
  std::string changed(text);
  changed[at] = 'e';
  return changed;
}

}  // namespace

Error unexpected(const std::string& expected, std::string_view found, const std::string& hint) {
  return {"expected " + expected + ", found \"" + std::string(found) + "\"", "", 0, 0, hint};
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<double> numbers_from_text(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view part : parts_of(text, ',')) {
    const std::optional<double> number = parse_double(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<double> parse_double(std::string_view text) {
  text = without_plus(text);
  if (text.empty()) return std::nullopt;
  double value = 0;
  const auto is_parsed = [&](std::string_view number) {
    const char* const end = number.data() + number.size();
    const auto parsed = fast_float::from_chars(number.data(), end, value);
    return parsed.ec != std::errc::invalid_argument && parsed.ptr == end;
  };
  if (is_parsed(text)) return value;
  const std::optional<std::string> changed = with_e(text);
  return changed && is_parsed(*changed) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> parse_int(std::string_view text) {
  text = without_plus(text);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return value;
}

Result<double> number_from_text(const std::string& text, double least, double most, bool open) {
  const std::optional<double> value = parse_double(text);
  if (value && (open ? *value > least && *value < most : *value >= least && *value <= most)) return *value;
  return unexpected(open ? "a number above " + fmt::format("{}", least) + " and below " + fmt::format("{}", most)
                         : "a number from " + fmt::format("{}", least) + " to " + fmt::format("{}", most),
                    text);
}

Result<std::int64_t> whole_number_from_text(const std::string& text, std::int64_t least, std::int64_t most) {
  const std::optional<std::int64_t> value = parse_int(text);
  if (value && *value >= least && *value <= most) return *value;
  const bool bounded = most != std::numeric_limits<std::int64_t>::max();
  return unexpected("a whole number " + (bounded ? "from " + std::to_string(least) + " to " + std::to_string(most)
                                                 : "of at least " + std::to_string(least)),
                    text);
}

}  // namespace bihive
