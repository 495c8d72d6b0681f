// Many rows of a table at once: the text is cut at line ends, and all threads read a part each. Rows, and the first
// error of the file, are those of one line after the other.
#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/parallel.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/text/column_numbers.h"
#include "bihive/io/text/plain_number.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

// Bytes of text between two joinings of the parts: as many as were read before, so that memory is asked for in time,
// and in these limits. A block has this many chunks. None of this depends on the number of threads.
constexpr std::int64_t kLeastBlockBytes = std::int64_t{1} << 18, kMostBlockBytes = std::int64_t{1} << 23;
constexpr std::int64_t kParts = 32;
// Rows that are read one by one first: most columns show by them what they hold.
constexpr std::int64_t kFirstRows = 16;

// Bytes are compared in groups that fit a counter of eight bits: compilers make vectors of that.
std::int64_t count_lines(std::string_view text) {
  std::int64_t lines = 0;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    const char* const stop = at + std::min<std::ptrdiff_t>(end - at, 255);
    unsigned char ends = 0;
    for (; at != stop; ++at) ends = static_cast<unsigned char>(ends + (*at == '\n'));
    lines += ends;
  }
  return lines + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

// The first N lines of the text, which has more.
std::string_view first_lines(std::string_view text, std::int64_t lines) {
  std::size_t end = 0;
  for (; lines > 0; --lines) end = text.find('\n', end) + 1;
  return text.substr(0, end);
}

bool next_row(TextScanner& scanner, SphereTable::RowLines lines) {
  if (lines == SphereTable::RowLines::all) return scanner.next_line();
  while (scanner.next_filled_line())
    if (trim(scanner.line()).front() != '#') return true;
  return false;
}

}  // namespace

// A part of the text, and its rows.
struct SphereTable::Part {
  SphereTable rows;
  std::string_view text;
  std::int64_t lines = 0, lines_before = 0;
  Status status = Done{};
  std::exception_ptr thrown;
};

// Whether no later row can change what a column holds.
bool SphereTable::is_decided() const {
  return std::all_of(columns_.begin(), columns_.end(), [](const Column& column) {
    return column.role != ColumnRole::number || column.is_text || column.has_number;
  });
}

SphereTable SphereTable::without_rows() const {
  SphereTable table{std::vector<TableColumn>()};
  for (const Column& column : columns_) {
    table.columns_.emplace_back();
    Column& copy = table.columns_.back();
    copy.name = column.name;
    copy.role = column.role;
    copy.is_chosen = column.is_chosen;
    copy.has_number = column.has_number;
    copy.is_text = column.is_text;
  }
  table.more_fields_allowed_ = more_fields_allowed_;
  return table;
}

void SphereTable::drop_rows() {
  rows_ = 0;
  for (Column& column : columns_) {
    column.values.clear();
    column.labels.clear();
  }
}

// The rows of the first `used` parts, behind these.
void SphereTable::append(std::vector<Part>& parts, std::size_t used) {
  std::vector<std::exception_ptr> thrown(columns_.size());
  parallel_for(0, static_cast<std::int64_t>(columns_.size()), [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    try {
      Column& column = columns_[at];
      for (std::size_t part = 0; part < used; ++part) {
        const Column& read = parts[part].rows.columns_[at];
        column.values.insert(column.values.end(), read.values.begin(), read.values.end());
        column.labels.append(read.labels);
      }
    } catch (...) {
      thrown[at] = std::current_exception();
    }
  });
  for (const std::exception_ptr& each : thrown)
    if (each) std::rethrow_exception(each);
  for (std::size_t part = 0; part < used; ++part) rows_ += parts[part].rows.rows_;
}

// A row whose fields stand between blanks and are what their columns hold; else false, and nothing is added.
bool SphereTable::add_plain_row(std::string_view line) {
  const char* at = line.data();
  const char* const end = at + line.size();
  const auto skip_blanks = [&] {
    while (at != end && is_blank(*at)) ++at;
  };
  row_numbers_.resize(columns_.size());
  row_texts_.resize(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    skip_blanks();
    if (at == end) return false;
    const Column& column = columns_[i];
    const bool is_number = column.role != ColumnRole::ignored && !column.is_text && !holds_labels(column.role);
    double value = 0;
    const char* const begin = at;
    if (!is_number || !take_plain_number(at, end, value) || (at != end && !is_blank(*at))) {
      at = begin;
      while (at != end && !is_blank(*at)) ++at;
      row_texts_[i] = {begin, static_cast<std::size_t>(at - begin)};
      if (!is_number) continue;
      const auto parsed = parse_double(row_texts_[i]);
      if (!parsed) return false;
      value = *parsed;
    }
    if (column.role != ColumnRole::number && number_fault(column.role, value) != nullptr) return false;
    row_numbers_[i] = value;
  }
  skip_blanks();
  if (at != end && !more_fields_allowed_) return false;

  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& column = columns_[i];
    if (column.role == ColumnRole::ignored) continue;
    if (column.is_text || holds_labels(column.role)) {
      column.labels.add(row_texts_[i]);
    } else {
      column.has_number = true;
      column.values.push_back(row_numbers_[i]);
    }
  }
  ++rows_;
  return true;
}

// All rows of a part, on this thread.
Status SphereTable::read_rows(TextScanner& scanner, RowLines lines) {
  const bool blanks_separate = scanner.separator() == TextScanner::kBlanks;
  while (next_row(scanner, lines)) {
    if (blanks_separate && add_plain_row(scanner.line())) continue;
    if (Status row = add_row(scanner); !row) return row;
  }
  return Done{};
}

Result<std::int64_t> SphereTable::add_rows(TextScanner& scanner, std::int64_t most, RowLines lines) {
  const std::int64_t before = rows_;
  const auto missing = [&] { return most - (rows_ - before); };
  while (missing() > 0 && (rows_ - before < kFirstRows || !is_decided())) {
    if (!next_row(scanner, lines)) return rows_ - before;
    if (Status row = add_row(scanner); !row) return row.error();
  }

  // A number takes two bytes of text at least and eight here: the numbers of a block stay within a quarter of the
  // memory.
  const auto most_block_bytes =
      std::clamp(static_cast<std::int64_t>(std::min(memory_bytes(), 0x1p62) / 16), kLeastBlockBytes, kMostBlockBytes);
  std::vector<Part> parts;
  std::int64_t read_bytes = 0;
  while (missing() > 0) {
    // Cut the next block into parts of whole lines.
    const std::int64_t block_bytes = std::clamp(read_bytes, kLeastBlockBytes, most_block_bytes);
    const auto part_bytes = static_cast<std::size_t>(block_bytes / kParts);
    const std::string_view block = scanner.peek_lines(block_bytes);
    if (block.empty()) break;
    std::size_t used = 0;
    for (std::size_t begin = 0; begin < block.size(); ++used) {
      std::string_view text = block.substr(begin);
      if (text.size() > part_bytes) {
        const std::size_t end = text.find('\n', part_bytes);
        text = text.substr(0, end == std::string_view::npos ? end : end + 1);
      }
      if (used == parts.size()) parts.push_back({without_rows(), {}, 0, 0, Done{}, nullptr});
      parts[used].text = text;
      begin += text.size();
    }

    // Count their lines. There are as many lines as rows at most.
    parallel_for(0, static_cast<std::int64_t>(used), [&](std::int64_t i) {
      Part& part = parts[static_cast<std::size_t>(i)];
      part.lines = count_lines(part.text);
    });
    std::int64_t taken = 0, block_lines = 0;
    for (std::size_t i = 0; i < used; ++i) {
      Part& part = parts[i];
      part.lines_before = block_lines;
      if (part.lines >= missing() - block_lines) {
        if (part.lines > missing() - block_lines) part.text = first_lines(part.text, missing() - block_lines);
        part.lines = missing() - block_lines;
        used = i + 1;
      }
      taken += static_cast<std::int64_t>(part.text.size());
      block_lines += part.lines;
    }

    // Read them.
    parallel_for(0, static_cast<std::int64_t>(used), [&](std::int64_t i) {
      Part& part = parts[static_cast<std::size_t>(i)];
      try {
        part.rows.drop_rows();
        TextScanner part_scanner = scanner.part(part.text, part.lines_before);
        part.status = part.rows.read_rows(part_scanner, lines);
      } catch (...) {
        part.thrown = std::current_exception();
      }
    });
    for (std::size_t i = 0; i < used; ++i) {
      if (parts[i].thrown) std::rethrow_exception(parts[i].thrown);
      if (!parts[i].status) return parts[i].status.error();
    }
    append(parts, used);
    scanner.skip_peeked(taken, block_lines);
    read_bytes += taken;
    if (const std::string fault = memory_fault(); !fault.empty()) return scanner.line_error(fault);
  }
  return rows_ - before;
}

}  // namespace bihive
