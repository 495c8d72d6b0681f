#include "bihive/io/text/continued_lines.h"

#include <algorithm>

#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The text's first line, which is taken from it.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

// Where the mark stands at the end of the line; npos: nowhere.
std::size_t mark_of(std::string_view line, char mark) {
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return !line.empty() && line.back() == mark ? line.size() - 1 : std::string_view::npos;
}

}  // namespace

std::string_view with_joined_lines(std::string_view text, const Continuation& how, std::string& joined) {
  constexpr std::size_t kNone = std::string_view::npos;
  std::string_view rest = text;
  std::size_t copied = 0;
  while (!rest.empty()) {
    const auto begin = static_cast<std::size_t>(rest.data() - text.data());
    std::string_view line = take_line(rest);
    std::size_t mark = mark_of(line, how.mark);
    if (mark == kNone || !how.may_go_on(line)) continue;
    std::string ends;
    while (mark != kNone && !rest.empty()) {
      std::string_view after = rest;
      std::string_view next = take_line(after);
      const std::size_t prefix = how.prefix(next);
      if (prefix == kNone) break;
      // All before this line, once.
      if (ends.empty()) joined += text.substr(copied, begin - copied);
      joined += line.substr(0, mark);
      joined += how.joint;
      line = next.substr(prefix);
      mark = mark_of(line, how.mark);
      rest = after;
      ends += '\n';
    }
    if (ends.empty()) continue;
    joined += line;
    joined += ends;
    copied = static_cast<std::size_t>(line.data() + line.size() - text.data());
  }
  if (copied == 0) return text;
  joined += text.substr(copied);
  return joined;
}

}  // namespace bihive
