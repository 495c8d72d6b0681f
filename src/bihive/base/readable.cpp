#include "bihive/base/readable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace bihive {

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::size_t first = value < 0 ? 1 : 0;
  for (std::size_t i = digits.size(); i > first + 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string readable_bytes(double bytes) {
  const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < std::size(units)) {
    bytes /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string range_text(double low, double high) {
  const double extent = high - low, farthest = std::max(std::abs(low), std::abs(high));
  const bool is_far = extent > 0 && std::isfinite(farthest / extent);
  const int more = is_far ? static_cast<int>(std::log10(std::max(1.0, farthest / extent))) : 0;
  const int digits = std::min(6 + more, 17);
  return fmt::format("{:.{}g} to {:.{}g}", low, digits, high, digits);
}

std::string readable_number(double value) {
  return fmt::format("{:g}", value);
}

namespace {

// The character at the beginning of the text and its length in bytes; length 0: no UTF-8.
struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 && first < 0xF5   ? 4
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xC2 && first < 0xE0 ? 2
                                                             : 0;
  if (length == 0 || text.size() < length) return {};
  std::uint32_t code = first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < smallest[length] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
  return {code, length};
}

struct CodeRange {
  std::uint32_t first, last;
};

// In ascending order. Unicode's categories Cc, Zl, Zp and Cf, without the two joiners and the signs of Cf that are
// seen.
constexpr CodeRange kHostile[] = {
    {0x00, 0x1F},        // C0
    {0x7F, 0x9F},        // DEL, C1
    {0xAD, 0xAD},        // soft hyphen
    {0x61C, 0x61C},      // Arabic letter mark
    {0x180E, 0x180E},    // Mongolian vowel separator
    {0x200B, 0x200B},    // space of zero width
    {0x200E, 0x200F},    // marks from left to right, from right to left
    {0x2028, 0x202E},    // separators of lines and paragraphs, embeddings and overrides
    {0x2060, 0x206F},    // word joiner, invisible operators, isolates, deprecated marks
    {0xFEFF, 0xFEFF},    // byte order mark
    {0xFFF9, 0xFFFB},    // annotations
    {0x1BCA0, 0x1BCA3},  // controls of shorthand
    {0x1D173, 0x1D17A},  // controls of musical notation
    {0xE0000, 0xE007F},  // tags
};

// Whether a terminal may interpret it as more than a letter, or show nothing for it.
bool is_hostile(std::uint32_t code) {
  for (const CodeRange& range : kHostile)
    if (code <= range.last) return code >= range.first;
  return false;
}

// `write_out` appends the replacement of a character, or of a stray byte (length 0).
template <class Keep, class WriteOut>
std::string cleaned(std::string_view text, Keep keep, WriteOut write_out) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t length = character.length == 0 ? 1 : character.length;
    if (character.length > 0 && (!is_hostile(character.code) || keep(character.code)))
      clean += text.substr(0, length);
    else
      write_out(clean, character, static_cast<unsigned char>(text[0]));
    text.remove_prefix(length);
  }
  return clean;
}

void write_out(std::string& line, Character character, unsigned byte) {
  if (character.length == 0)
    line += fmt::format("\\x{:02x}", byte);
  else if (character.code == '\n')
    line += "\\n";
  else if (character.code < 0x80)
    line += fmt::format("\\x{:02x}", character.code);
  else if (character.code < 0x10000)
    line += fmt::format("\\u{:04x}", character.code);
  else
    line += fmt::format("\\U{:08x}", character.code);
}

}  // namespace

std::string escaped(std::string_view text) {
  return cleaned(
      text, [](std::uint32_t) { return false; }, write_out);
}

std::string escaped_lines(std::string_view text) {
  return cleaned(
      text, [](std::uint32_t code) { return code == '\n' || code == '\t'; }, write_out);
}

std::string masked(std::string_view text) {
  return cleaned(
      text, [](std::uint32_t) { return false; }, [](std::string& line, Character, unsigned) { line += '?'; });
}

std::string one_line(std::string_view text, std::size_t most_bytes) {
  constexpr std::string_view kEllipsis = "\u2026";
  const std::string clean = cleaned(
      text, [](std::uint32_t) { return false; }, [](std::string& line, Character, unsigned) { line += ' '; });
  std::string line;
  for (const char c : clean)
    if (c != ' ' || (!line.empty() && line.back() != ' ')) line += c;
  if (!line.empty() && line.back() == ' ') line.pop_back();
  if (line.size() <= most_bytes) return line;
  // Not within a character.
  std::size_t end = most_bytes - kEllipsis.size();
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0u) == 0x80) --end;
  while (end > 0 && line[end - 1] == ' ') --end;
  return line.substr(0, end).append(kEllipsis);
}

}  // namespace bihive
