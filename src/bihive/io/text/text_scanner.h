// Walks through text line by line and field by field, and knows its place.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bihive/base/ascii.h"
#include "bihive/base/result.h"

namespace bihive {

class RandomFile;

/// A part of a file that is scanned without being in memory as a whole.
struct FileText {
  const RandomFile& file;
  std::int64_t begin = 0, end = 0;  ///< bytes
  std::int64_t lines_before = 0;
  std::optional<Error> fault;  ///< why the file could not be read; the text then ends there
};

/// Lines end in "\n" or "\r\n"; the last line may have no end. The text must outlive the scanner.
class TextScanner {
 public:
  /// Fields are separated by runs of blanks and tabs.
  static constexpr char kBlanks = ' ';

  TextScanner(std::string_view text, std::string file);
  /// A window of the part lies in memory at a time: a view into a line lives until the next line. The part must outlive
  /// the scanner and its copies. Look at its fault at the end.
  explicit TextScanner(FileText& part);

  /// kBlanks, or the one character between fields; then a field may be empty or "quoted" (with "" for a quote inside).
  /// Begins the current line again.
  void set_separator(char separator);
  char separator() const { return separator_; }
  /// This character begins a comment, which goes to the end of the line; 0 for none. Begins the current line again.
  void set_comment(char comment);
  /// Begins the current line again.
  void restart_line();

  /// Goes to the next line; false at the end of the text.
  bool next_line();
  /// Goes to the next line that has more than blanks (and a comment) in it.
  bool next_filled_line();

  /// The whole lines after the current one: about this many bytes, at least one line, none at the end. The view
  /// lives until the scanner goes on.
  std::string_view peek_lines(std::int64_t bytes);
  /// Skips the first bytes of peek_lines(), which are this number of lines. The last of them is the current line then,
  /// but its text is not read.
  void skip_peeked(std::int64_t bytes, std::int64_t lines);
  /// A scanner of the rest of peek_lines() after this number of lines; its errors name the file's lines.
  TextScanner part(std::string_view lines, std::int64_t lines_before) const;

  std::string_view line() const { return line_; }
  std::int64_t line_number() const { return line_number_; }
  bool at_end() const { return next_ == text_.size() && !more_in_file(); }
  /// Bytes of the file before the next line.
  std::int64_t place() const;
  /// The rest behind the current line: lines, counted in one fast pass, and bytes.
  std::int64_t lines_left() const;
  std::int64_t bytes_left() const;
  /// False if the text's last line has no line end.
  bool ends_in_newline() const { return ends_in_newline_; }

  /// Takes the next field of the line, without blanks around it; false if there is none. The view lives until the next
  /// call. A quote that is not closed on its line gives the rest of the line with the quote.
  bool next_field(std::string_view& field);
  /// The number of fields left in the line; takes none of them.
  std::int64_t count_fields() const;

  /// An error at the field taken last, at the current line as a whole (at the end of the text: its last line), or at a
  /// column of it, counted from 1.
  Error field_error(const std::string& message, const std::string& hint = "") const;
  Error line_error(const std::string& message, const std::string& hint = "") const;
  Error column_error(std::int64_t column, const std::string& message, const std::string& hint = "") const;

  const std::string& file() const { return file_; }

 private:
  bool next_quoted_field(std::string_view& field);
  void tell_watcher() const;
  bool more_in_file() const;
  void take_more(std::int64_t bytes);

  std::string_view text_;  // all of it, or the window
  FileText* part_ = nullptr;
  std::shared_ptr<std::string> window_;  // of the part
  std::int64_t text_end_ = 0;            // byte of the file behind text_
  std::int64_t begin_ = 0, end_ = 0;     // bytes of the file that are scanned
  bool ends_in_newline_ = true;
  std::string file_;
  char separator_ = kBlanks;
  char comment_ = 0;
  std::size_t next_ = 0;         // where the next line begins
  std::string_view whole_line_;  // with its comment
  std::string_view line_;
  std::int64_t line_number_ = 0;
  std::size_t cursor_ = 0;       // in line_, behind the field taken last
  std::size_t field_begin_ = 0;  // in line_
  bool more_fields_ = false;     // with a separator: one more field follows; it may be empty
  std::string unquoted_;
};

/// The text with a question mark in place of every character and byte that a terminal should not get (masked()).
std::string printable(std::string_view text);

/// The printable text in quotes, shortened for messages.
std::string quote(std::string_view text);

}  // namespace bihive
