#include "bihive/io/text/text_scanner.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "bihive/base/readable.h"
#include "bihive/base/watch.h"
#include "bihive/io/packed/random_file.h"

namespace bihive {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Bytes of a file that are read at once. From 64 kB to 4 MB it makes no difference that can be measured.
constexpr std::int64_t kWindowBytes = std::int64_t{1} << 18;

// Lines from one report of progress to the next: a power of two, so that the test costs little.
constexpr std::int64_t kWatchedLines = 4096;
// The share of reading that is over at the end of the text: sets are made of the numbers then.
constexpr double kShareOfText = 0.8;

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file)
    : text_(text), text_end_(static_cast<std::int64_t>(text.size())), end_(text_end_), file_(std::move(file)) {
  if (text_.substr(0, 3) == kByteOrderMark) text_.remove_prefix(3);
  ends_in_newline_ = text_.empty() || text_.back() == '\n';
}

TextScanner::TextScanner(FileText& part)
    : part_(&part),
      text_end_(part.begin),
      begin_(part.begin),
      end_(part.end),
      file_(part.file.path()),
      line_number_(part.lines_before) {
  take_more(kWindowBytes);
  if (part.begin == 0 && text_.substr(0, 3) == kByteOrderMark) text_.remove_prefix(3);
  if (text_.empty()) return;
  char last = text_.back();
  if (more_in_file())
    if (const Result<std::string> bytes = part.file.read(part.end - 1, 1)) last = bytes->front();
  ends_in_newline_ = last == '\n';
}

bool TextScanner::more_in_file() const {
  return part_ != nullptr && text_end_ < part_->end && !part_->fault;
}

// Moves the start of the window to the next line, and reads about this many more bytes of the file after it.
void TextScanner::take_more(std::int64_t bytes) {
  if (!more_in_file()) return;
  // A copy of this scanner may look into the old window.
  auto window = window_ && window_.use_count() == 1 ? window_ : std::make_shared<std::string>();
  const std::size_t kept = text_.size() - next_;
  const char* const rest = text_.data() + next_;
  // A long line takes twice as much each time.
  const std::int64_t count = std::min(part_->end - text_end_, std::max(bytes, static_cast<std::int64_t>(kept)));
  // It does not shrink, as what it gets again would be cleared first. `rest` may lie in it, at its old place.
  const std::size_t wanted = kept + static_cast<std::size_t>(count);
  if (window == window_ && window->size() >= wanted) {
    std::memmove(window->data(), rest, kept);
  } else {
    std::string larger(wanted, '\0');
    std::copy(rest, rest + kept, larger.begin());
    *window = std::move(larger);
  }
  std::size_t have = kept;
  if (Status status = part_->file.read_into(text_end_, count, window->data() + kept); !status) {
    part_->fault = status.error();
  } else {
    text_end_ += count;
    have = wanted;
  }
  window_ = std::move(window);
  text_ = std::string_view(*window_).substr(0, have);
  next_ = 0;
}

std::int64_t TextScanner::place() const {
  return text_end_ - static_cast<std::int64_t>(text_.size() - next_);
}

std::int64_t TextScanner::bytes_left() const {
  return static_cast<std::int64_t>(text_.size() - next_) + (part_ != nullptr ? part_->end - text_end_ : 0);
}

bool TextScanner::next_line() {
  // Find the end of the line.
  const void* found = nullptr;
  for (;;) {
    const std::size_t have = text_.size() - next_;
    if (have > 0) found = std::memchr(text_.data() + next_, '\n', have);
    if (found != nullptr || !more_in_file()) break;
    take_more(kWindowBytes);
  }
  const char* const begin = text_.data() + next_;
  const std::size_t left = text_.size() - next_;
  if (left == 0) return false;
  const std::size_t length = found ? static_cast<std::size_t>(static_cast<const char*>(found) - begin) : left;
  next_ += found ? length + 1 : length;
  ++line_number_;
  if (line_number_ % kWatchedLines == 0) tell_watcher();

  whole_line_ = std::string_view(begin, length);
  if (!whole_line_.empty() && whole_line_.back() == '\r') whole_line_.remove_suffix(1);
  restart_line();
  return true;
}

void TextScanner::tell_watcher() const {
  stop_if_cancelled(kShareOfText * static_cast<double>(place() - begin_) / static_cast<double>(end_ - begin_));
}

std::string_view TextScanner::peek_lines(std::int64_t bytes) {
  const auto wanted = static_cast<std::size_t>(bytes);
  for (;;) {
    // A window that is too small, or one line that is longer.
    const std::string_view left = text_.substr(next_);
    if (left.size() >= wanted || !more_in_file()) {
      if (left.size() <= wanted && !more_in_file()) return left;
      const std::size_t last = left.rfind('\n', wanted - 1);
      if (last != std::string_view::npos) return left.substr(0, last + 1);
      const std::size_t end = left.find('\n');
      if (end != std::string_view::npos) return left.substr(0, end + 1);
      if (!more_in_file()) return left;
    }
    take_more(std::max(kWindowBytes, bytes - static_cast<std::int64_t>(left.size())));
  }
}

void TextScanner::skip_peeked(std::int64_t bytes, std::int64_t lines) {
  next_ += static_cast<std::size_t>(bytes);
  line_number_ += lines;
  tell_watcher();
  whole_line_ = {};
  restart_line();
}

TextScanner TextScanner::part(std::string_view lines, std::int64_t lines_before) const {
  TextScanner scanner("", file_);
  scanner.text_ = lines;
  scanner.end_ = scanner.text_end_ = static_cast<std::int64_t>(lines.size());
  scanner.ends_in_newline_ = lines.empty() || lines.back() == '\n';
  scanner.separator_ = separator_;
  scanner.comment_ = comment_;
  scanner.line_number_ = line_number_ + lines_before;
  return scanner;
}

void TextScanner::restart_line() {
  line_ = comment_ ? whole_line_.substr(0, whole_line_.find(comment_)) : whole_line_;
  cursor_ = field_begin_ = 0;
  more_fields_ = separator_ != kBlanks;
}

void TextScanner::set_separator(char separator) {
  separator_ = separator;
  restart_line();
}

void TextScanner::set_comment(char comment) {
  comment_ = comment;
  restart_line();
}

bool TextScanner::next_filled_line() {
  while (next_line())
    if (!trim(line_).empty()) return true;
  return false;
}

std::int64_t TextScanner::lines_left() const {
  if (at_end()) return 0;
  BIHIVE_CHECK(part_ == nullptr);
  return std::count(text_.begin() + static_cast<std::ptrdiff_t>(next_), text_.end(), '\n') + !ends_in_newline();
}

bool TextScanner::next_field(std::string_view& field) {
  if (separator_ != kBlanks) return next_quoted_field(field);
  while (cursor_ < line_.size() && is_blank(line_[cursor_])) ++cursor_;
  field_begin_ = cursor_;
  while (cursor_ < line_.size() && !is_blank(line_[cursor_])) ++cursor_;
  field = line_.substr(field_begin_, cursor_ - field_begin_);
  return !field.empty();
}

bool TextScanner::next_quoted_field(std::string_view& field) {
  if (!more_fields_) {
    field_begin_ = line_.size();
    return false;
  }
  while (cursor_ < line_.size() && is_blank(line_[cursor_]) && line_[cursor_] != separator_) ++cursor_;
  field_begin_ = cursor_;

  // Without quotes the field goes to the next separator.
  if (cursor_ == line_.size() || line_[cursor_] != '"') {
    const std::size_t end = std::min(line_.find(separator_, cursor_), line_.size());
    field = trim(line_.substr(cursor_, end - cursor_));
    more_fields_ = end < line_.size();
    cursor_ = end + (more_fields_ ? 1 : 0);
    return true;
  }

  // With quotes it goes to the first quote that is not doubled.
  unquoted_.clear();
  std::size_t at = cursor_ + 1;
  while (at < line_.size()) {
    if (line_[at] != '"') {
      unquoted_ += line_[at++];
    } else if (at + 1 < line_.size() && line_[at + 1] == '"') {
      unquoted_ += '"';
      at += 2;
    } else {
      break;
    }
  }
  const std::size_t end = std::min(line_.find(separator_, at), line_.size());
  const bool clean = at < line_.size() && trim(line_.substr(at + 1, end - at - 1)).empty();
  field = clean ? std::string_view(unquoted_) : line_.substr(cursor_, end - cursor_);
  more_fields_ = end < line_.size();
  cursor_ = end + (more_fields_ ? 1 : 0);
  return true;
}

std::int64_t TextScanner::count_fields() const {
  TextScanner rest(*this);
  std::string_view field;
  std::int64_t count = 0;
  while (rest.next_field(field)) ++count;
  return count;
}

Error TextScanner::field_error(const std::string& message, const std::string& hint) const {
  return column_error(static_cast<std::int64_t>(field_begin_) + 1, message, hint);
}

Error TextScanner::line_error(const std::string& message, const std::string& hint) const {
  return column_error(0, message, hint);
}

Error TextScanner::column_error(std::int64_t column, const std::string& message, const std::string& hint) const {
  return {message, file_, line_number_, column, hint};
}

std::string printable(std::string_view text) {
  return masked(text);
}

std::string quote(std::string_view text) {
  constexpr std::size_t kReadable = 40;
  return "'" + printable(text.substr(0, kReadable)) + (text.size() > kReadable ? "...'" : "'");
}

}  // namespace bihive
