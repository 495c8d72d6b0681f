#include "bihive/io/formats/molecules/xyz_comment.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr bool is_quote(char c) {
  return c == '"' || c == '\'';
}

// The mark that closes this one; 0: it opens nothing.
constexpr char closing(char c) {
  return is_quote(c) ? c : c == '{' ? '}' : c == '[' ? ']' : '\0';
}

// Goes through a line from the front.
class Cursor {
 public:
  explicit Cursor(std::string_view line) : line_(line) {}

  bool at_end() const { return at_ == line_.size(); }
  char next() const { return at_end() ? '\0' : line_[at_]; }
  std::size_t place() const { return at_; }
  void skip(std::size_t count) { at_ += count; }
  void skip_blanks() {
    while (!at_end() && is_blank(line_[at_])) ++at_;
  }

  // Up to the mark that closes the present one, which is passed; nothing, and the place stays, if none does. Brackets
  // may hold each other and quoted texts. A backslash takes the next character as it is.
  std::optional<std::string> take_closed() {
    const char open = next(), close = closing(open);
    std::string text;
    int depth = 1;
    for (std::size_t i = at_ + 1; i < line_.size(); ++i) {
      const char c = line_[i];
      if (c == '\\' && i + 1 < line_.size()) {
        text += line_[++i];
        continue;
      }
      if (c == close && --depth == 0) {
        at_ = i + 1;
        return text;
      }
      if (c == open) ++depth;
      text += c;
    }
    return std::nullopt;
  }

  // Up to a blank, or to an equals sign as well.
  std::string take_bare(bool stops_at_equals) {
    const std::size_t begin = at_;
    while (!at_end() && !is_blank(line_[at_]) && !(stops_at_equals && line_[at_] == '=')) ++at_;
    return std::string(line_.substr(begin, at_ - begin));
  }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

}  // namespace

XyzComment::XyzComment(std::string_view line) {
  Cursor cursor(line);
  const auto take = [&](bool is_key) {
    if (closing(cursor.next()) == '\0' || (is_key && !is_quote(cursor.next()))) return cursor.take_bare(is_key);
    std::optional<std::string> closed = cursor.take_closed();
    const bool ends = cursor.at_end() || is_blank(cursor.next()) || cursor.next() == (is_key ? '=' : ',');
    if (!unclear_at_ && (!closed || !ends)) unclear_at_ = cursor.place() + 1;
    return closed ? *closed : cursor.take_bare(is_key);
  };
  for (cursor.skip_blanks(); !cursor.at_end(); cursor.skip_blanks()) {
    const std::size_t begin = cursor.place();
    const std::string key = take(true);
    cursor.skip_blanks();
    if (cursor.next() == '=') {
      cursor.skip(1);
      cursor.skip_blanks();
      // The commas of some writers separate entries.
      entries_.emplace_back(lower_case(trim(key.substr(std::min(key.find_first_not_of(", "), key.size())))),
                            take(false));
    }
    if (cursor.place() == begin) cursor.skip(1);
  }
}

std::optional<std::string_view> XyzComment::find(std::string_view key) const {
  return find_any({key});
}

std::optional<std::string_view> XyzComment::find_any(std::initializer_list<std::string_view> keys) const {
  for (const auto& [name, value] : entries_)
    if (std::find(keys.begin(), keys.end(), name) != keys.end()) return value;
  return std::nullopt;
}

std::optional<std::vector<double>> xyz_numbers(std::string_view value) {
  std::string plain(value);
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == ',' || c == '[' || c == ']'; }, ' ');
  std::vector<double> numbers;
  TextScanner scanner(plain, "");
  if (!scanner.next_line()) return numbers;
  for (std::string_view field; scanner.next_field(field);) {
    const std::optional<double> number = parse_double(field);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<std::array<bool, 3>> xyz_flags(std::string_view value) {
  std::vector<bool> flags;
  const auto is_between = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == '[' || c == ']'; };
  for (std::size_t at = 0; at < value.size();) {
    if (is_between(value[at])) {
      ++at;
      continue;
    }
    std::size_t stop = at;
    while (stop < value.size() && !is_between(value[stop])) ++stop;
    const std::string word = lower_case(value.substr(at, stop - at));
    const bool yes = word == "t" || word == "true" || word == ".true." || word == "1";
    if (!yes && word != "f" && word != "false" && word != ".false." && word != "0") return std::nullopt;
    flags.push_back(yes);
    at = stop;
  }
  if (flags.size() != 3) return std::nullopt;
  return std::array<bool, 3>{flags[0], flags[1], flags[2]};
}

}  // namespace bihive
