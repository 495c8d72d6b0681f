// Lines that go on in the next one, for formats that are read line by line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bihive {

struct Continuation {
  char mark;               ///< the last character of a line that goes on, blanks aside
  std::string_view joint;  ///< stands in place of mark and line end
  /// Whether such a line may go on, and how many characters of the next line stand before its continuation (npos: it
  /// is none).
  bool (*may_go_on)(std::string_view line);
  std::size_t (*prefix)(std::string_view next_line);
};

/// The text with continued lines in one, and empty lines in place of those that were joined: later lines keep their
/// numbers. `joined` holds it, unless no line goes on.
std::string_view with_joined_lines(std::string_view text, const Continuation& how, std::string& joined);

}  // namespace bihive
