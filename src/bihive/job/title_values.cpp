#include "bihive/job/title_values.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "bihive/base/ascii.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/values.h"

namespace bihive {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  for (const std::string_view field : parts_of(line, ',')) fields.emplace_back(trim(field));
  return fields;
}

// Line `number` of the text, from 0; false if it has fewer.
bool take_line(const std::string& text, std::int64_t number, std::string& line) {
  std::size_t begin = 0;
  for (std::int64_t i = 0; i < number; ++i) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return false;
    ++begin;
  }
  if (begin >= text.size()) return false;
  line = text.substr(begin, text.find('\n', begin) - begin);
  return true;
}

}  // namespace

TitleValues values_of_frame(const std::string& path, std::int64_t frame) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const std::string text = value_or_fail(read_file(path));
  std::string head, row;
  if (!take_line(text, 0, head)) fail({"has no line of names", path, 1, 0, "the first line names the columns"});
  if (!take_line(text, frame + 1, row) || trim(row).empty())
    fail({"has no row for frame " + std::to_string(frame), path, frame + 2, 0, "each frame has a row, from 0 on"});
  const std::vector<std::string> names = fields_of(head), fields = fields_of(row);
  if (names.size() != fields.size())
    fail({"expected " + std::to_string(names.size()) + " fields, found " + std::to_string(fields.size()), path,
          frame + 2, 0, ""});
  TitleValues values;
  values.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      fail({"two columns have the name \"" + names[i] + "\"", path, 1, 0, "rename one of them"});
    if (fields[i].empty()) {
      values.emplace_back(names[i], std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const Result<double> number = number_from_text(fields[i], -kLargest, kLargest);
    if (!number) fail({number.error().message, path, frame + 2, 0, "the table holds numbers alone"});
    values.emplace_back(names[i], *number);
  }
  return values;
}

}  // namespace bihive
