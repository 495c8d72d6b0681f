#include "bihive/io/text/title.h"

#include <algorithm>

#include "bihive/base/readable.h"

namespace bihive {
namespace {

constexpr std::size_t kLongestTitle = 300, kLongestEntryId = 40;

// Beyond ASCII everything counts.
bool is_letter_or_digit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
         static_cast<unsigned char>(c) >= 0x80;
}

std::string named(std::string_view text, std::size_t most_bytes) {
  std::string line = one_line(text, most_bytes);
  return std::any_of(line.begin(), line.end(), is_letter_or_digit) ? line : std::string();
}

}  // namespace

std::string title_from(std::string_view text) {
  return named(text, kLongestTitle);
}

std::string entry_id_from(std::string_view text) {
  return named(text, kLongestEntryId);
}

}  // namespace bihive
