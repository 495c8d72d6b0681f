#include "bihive/io/text/title.h"

#include <algorithm>

#include "bihive/base/ascii.h"
#include "bihive/base/readable.h"

namespace bihive {
namespace {

constexpr std::size_t kLongestTitle = 300, kLongestEntryId = 40;

// Beyond ASCII everything counts.
bool is_of_a_name(char c) {
  return is_letter_or_digit(c) || static_cast<unsigned char>(c) >= 0x80;
}

std::string named(std::string_view text, std::size_t most_bytes) {
  std::string line = one_line(text, most_bytes);
  return std::any_of(line.begin(), line.end(), is_of_a_name) ? line : std::string();
}

}  // namespace

std::string title_from(std::string_view text) {
  return named(text, kLongestTitle);
}

std::string entry_id_from(std::string_view text) {
  return named(text, kLongestEntryId);
}

}  // namespace bihive
