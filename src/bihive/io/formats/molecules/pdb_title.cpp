#include "bihive/io/formats/molecules/pdb_title.h"

#include <algorithm>

#include "bihive/base/ascii.h"
#include "bihive/io/formats/molecules/pdb_columns.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

// More than a title has room for.
constexpr std::size_t kMostLines = 16;

bool is_entry_id(std::string_view text) {
  return text.size() == 4 && is_digit(text[0]) && std::all_of(text.begin(), text.end(), is_letter_or_digit);
}

}  // namespace

void PdbTitle::add_line(std::string_view line) {
  const std::string_view record = trim(line.substr(0, 6));
  if (record == "HEADER") {
    const std::string_view id = pdb_columns(line, 63, 66);
    if (entry_id_.empty() && is_entry_id(id)) entry_id_ = id;
  } else if (record == "TITLE" || record == "COMPND") {
    std::vector<std::string>& lines = record == "TITLE" ? title_ : compound_;
    if (lines.size() < kMostLines) lines.emplace_back(line);
  }
}

// The text of continuation lines is in columns 11 to 80. Lines of old files end in the entry's id and a line number.
std::string PdbTitle::joined(const std::vector<std::string>& lines) const {
  std::string text;
  for (const std::string& line : lines) {
    const bool is_numbered = !entry_id_.empty() && pdb_columns(line, 73, 76) == entry_id_;
    const std::string_view part = trim(pdb_columns(line, 11, is_numbered ? 72 : 80));
    // A word may be divided behind its hyphen.
    const bool goes_on = text.size() >= 2 && text.back() == '-' && text[text.size() - 2] != ' ';
    if (!text.empty() && !goes_on) text += ' ';
    text += part;
  }
  return title_from(text);
}

std::string PdbTitle::title() const {
  if (std::string title = joined(title_); !title.empty()) return title;
  std::string compound = joined(compound_);
  const bool is_list = compound.find("MOL_ID") != std::string::npos || compound.find("MOLECULE:") != std::string::npos;
  return is_list || compound == "UNNAMED" ? std::string() : compound;
}

}  // namespace bihive
