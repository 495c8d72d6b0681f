#include "bihive/io/part_of_dump.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/text/parse_number.h"
#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// All before the first atom is much shorter.
constexpr std::int64_t kDumpHeadBytes = 1 << 16;

// Lines differ in length, but not by so much that two frames are taken for one.
constexpr double kMostOfLines = 1.5;

// The lines before the atoms, around the one that says how many there are.
struct DumpHead {
  std::string before_count, after_count;
  std::int64_t atoms = 0;
  std::int64_t lines = 0, count_line = 0;
  std::int64_t end = 0;   // where the first atom begins
  double line_bytes = 0;  // of the first atoms, in the mean
};

bool can_be_divided(std::string_view columns) {
  TextScanner scanner(columns, "");
  scanner.next_line();
  for (std::string_view name; scanner.next_field(name);)
    if (needs_all_rows(usual_role(name))) return false;
  return true;
}

// Nothing: it does not begin so.
std::optional<DumpHead> head_of(const RandomFile& file) {
  const Result<std::string> bytes = file.read(0, std::min(kDumpHeadBytes, file.size()));
  if (!bytes || bytes->substr(0, 5) != "ITEM:") return std::nullopt;
  DumpHead head;
  std::optional<std::int64_t> atoms;
  for (std::size_t at = 0; at < bytes->size();) {
    const std::size_t newline = bytes->find('\n', at);
    if (newline == std::string::npos) return std::nullopt;
    const std::string line = bytes->substr(at, newline + 1 - at);
    at = newline + 1;
    ++head.lines;
    (atoms ? head.after_count : head.before_count) += line;
    const std::string_view words = trim(std::string_view(line).substr(0, line.size() - 1));
    if (words == "ITEM: NUMBER OF ATOMS" && !atoms) {
      const std::size_t end = bytes->find('\n', at);
      if (end == std::string::npos) return std::nullopt;
      atoms = parse_int(trim(std::string_view(*bytes).substr(at, end - at)));
      if (!atoms) return std::nullopt;
      at = end + 1;
      head.count_line = ++head.lines;
    } else if (words.substr(0, 11) == "ITEM: ATOMS") {
      if (!atoms || !can_be_divided(words.substr(11))) return std::nullopt;
      const std::string_view rest = std::string_view(*bytes).substr(at);
      const auto lines = std::count(rest.begin(), rest.end(), '\n');
      if (lines == 0) return std::nullopt;
      head.line_bytes = static_cast<double>(rest.rfind('\n') + 1) / static_cast<double>(lines);
      head.atoms = *atoms;
      head.end = static_cast<std::int64_t>(at);
      return head;
    }
  }
  return std::nullopt;
}

// The beginning of the first line at `place` or behind it.
Result<std::int64_t> next_line(const RandomFile& file, std::int64_t first, std::int64_t place) {
  if (place <= first) return first;
  for (std::int64_t at = place - 1; at < file.size(); at += kDumpHeadBytes) {
    const Result<std::string> bytes = file.read(at, std::min(kDumpHeadBytes, file.size() - at));
    if (!bytes) return bytes.error();
    if (const std::size_t newline = bytes->find('\n'); newline != std::string::npos)
      return at + static_cast<std::int64_t>(newline) + 1;
  }
  return file.size();
}

std::int64_t lines_in(std::string_view text) {
  const auto newlines = std::count(text.begin(), text.end(), '\n');
  return newlines + (text.empty() || text.back() == '\n' ? 0 : 1);
}

}  // namespace

std::optional<std::int64_t> atoms_in_parts(const RandomFile& file) {
  const std::optional<DumpHead> head = head_of(file);
  if (!head) return std::nullopt;
  const double expected = static_cast<double>(head->atoms) * head->line_bytes;
  if (static_cast<double>(file.size() - head->end) >= kMostOfLines * expected) return std::nullopt;
  return head->atoms;
}

Result<RawSpheres> part_of_dump(const RandomFile& file, const SetParts& parts) {
  const std::optional<DumpHead> head = head_of(file);
  if (!head) return Error{"parts of this file cannot be read", file.path(), 0, 0, ""};

  // The lines of this process, behind a head that counts them.
  const RowRange share = rows_of_part(&parts, file.size() - head->end);
  const Result<std::int64_t> first = next_line(file, head->end, head->end + share.first);
  if (!first) return first.error();
  const Result<std::int64_t> end = next_line(file, head->end, head->end + share.end);
  if (!end) return end.error();
  if (Status status = check_memory(static_cast<double>(*end - *first), "a part of the text"); !status)
    return Error{status.error().message, file.path(), 0, 0, ""};
  Result<std::string> lines = file.read(*first, *end - *first);
  if (!lines) return lines.error();
  // Nobody counts blank lines at the end.
  if (*end == file.size())
    while (!lines->empty() && std::string_view(" \t\r\n").find(lines->back()) != std::string_view::npos)
      lines->pop_back();
  const std::int64_t rows = lines_in(*lines);
  const CountOfParts all = count_of_all(&parts, rows);
  if (all.all != head->atoms)
    return Error{
        "the dump promises " + std::to_string(head->atoms) + " atoms, but " + std::to_string(all.all) + " lines follow",
        file.path(), head->count_line, 0,
        "is the file whole? With several frames leave out --distribute, or give the first a file of its own"};
  std::string text = head->before_count + std::to_string(rows) + "\n" + head->after_count;
  text += *lines;
  lines = std::string();

  Result<RawSpheres> spheres = read_bytes(format_named("LAMMPS dump"), text, file.path(), 0);
  if (spheres) return spheres;
  Error error = spheres.error();
  if (error.line > head->lines) error.line += all.before;
  return error;
}

}  // namespace bihive
