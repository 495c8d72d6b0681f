#include "bihive/io/chunk_of_dump.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// All before the first atom is much shorter.
constexpr std::int64_t kDumpHeadBytes = 1 << 16;

// Lines differ in length, but not by so much that two frames are taken for one.
constexpr double kMostOfLines = 1.5;

bool can_be_divided(std::string_view columns) {
  TextScanner scanner(columns, "");
  scanner.next_line();
  for (std::string_view name; scanner.next_field(name);)
    if (needs_all_rows(usual_role(name))) return false;
  return true;
}

// Whether the ids of these lines increase, if there are ids. A dump that LAMMPS did not sort shows it at once.
bool ids_increase(std::string_view columns, std::string_view lines) {
  TextScanner header(columns, "");
  header.next_line();
  std::int64_t before_id = 0;
  std::string_view field;
  for (bool found = false; !found; ++before_id) {
    if (!header.next_field(field)) return true;
    found = lower_case(field) == "id";
  }
  TextScanner scanner(lines, "");
  std::optional<double> last;
  while (scanner.next_line()) {
    for (std::int64_t i = 0; i < before_id; ++i) scanner.next_field(field);
    const std::optional<double> id = parse_double(field);
    if (last && id && !(*last < *id)) return false;
    last = id;
  }
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
      head.ids_increase = ids_increase(words.substr(11), rest.substr(0, rest.rfind('\n') + 1));
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

std::optional<std::int64_t> atoms_in_chunks(const RandomFile& file) {
  const std::optional<DumpHead> head = head_of(file);
  if (!head || !head->ids_increase) return std::nullopt;
  const double expected = static_cast<double>(head->atoms) * head->line_bytes;
  if (static_cast<double>(file.size() - head->end) >= kMostOfLines * expected) return std::nullopt;
  return head->atoms;
}

Result<DumpChunk> DumpChunk::read(const RandomFile& file, RowChunk chunk) {
  DumpChunk made;
  made.path_ = file.path();
  std::optional<DumpHead> head = head_of(file);
  if (!head) return Error{"parts of this file cannot be read", file.path(), 0, 0, ""};

  // The lines that begin in this chunk of the bytes.
  const RowRange share = chunk.of(file.size() - head->end);
  const Result<std::int64_t> first = next_line(file, head->end, head->end + share.first);
  if (!first) return first.error();
  const Result<std::int64_t> end = next_line(file, head->end, head->end + share.end);
  if (!end) return end.error();
  if (Status status = check_memory(static_cast<double>(*end - *first), "a chunk of the text"); !status)
    return Error{status.error().message, file.path(), 0, 0, ""};
  Result<std::string> lines = file.read(*first, *end - *first);
  if (!lines) return lines.error();
  // Nobody counts blank lines at the end.
  if (*end == file.size())
    while (!lines->empty() && std::string_view(" \t\r\n").find(lines->back()) != std::string_view::npos)
      lines->pop_back();
  made.rows_ = lines_in(*lines);
  made.head_ = std::move(*head);
  made.lines_ = std::move(*lines);
  return made;
}

Result<RawSpheres> DumpChunk::spheres(std::int64_t first, std::int64_t all) {
  if (all != head_.atoms)
    return Error{
        "the dump promises " + std::to_string(head_.atoms) + " atoms, but " + std::to_string(all) + " lines follow",
        path_, head_.count_line, 0,
        "is the file whole? With several frames leave out " + setting_name("distribute") +
            ", or give the first a file of its own"};
  // A head that counts the lines of this chunk.
  std::string text = head_.before_count + std::to_string(rows_) + "\n" + head_.after_count;
  text += lines_;
  lines_ = std::string();
  Result<RawSpheres> spheres = read_bytes(format_named("LAMMPS dump"), text, path_, 0);
  if (spheres) return spheres;
  Error error = spheres.error();
  if (error.line > head_.lines) error.line += first;
  return error;
}

}  // namespace bihive
