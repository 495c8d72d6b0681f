// Formats that bihive knows and does not read: for a message that names the format and what to do with it.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

struct ForeignFormat {
  std::string_view key;
  std::string_view name;        ///< "a run input file of GROMACS (TPR)"
  std::string_view endings;     ///< ".tpr"
  std::string_view advice;      ///< "convert it with 'gmx editconf -f FILE.tpr -o OUT.pdb'"
  std::string_view marks = "";  ///< first bytes, which no other format has: "PSF |PSF\n"
};

/// Content that a reader of bihive would take for its own, and that would be wrong: texts in UTF-16, texts whose lines
/// end in CR alone, CSSR. Null if it is none of those.
const ForeignFormat* foreign_before_all(std::string_view bytes);

/// The format of unpacked bytes, by their content alone, or by the ending of the name (before .gz and the like); null
/// if it is none of those known.
const ForeignFormat* foreign_by_content(std::string_view bytes);
const ForeignFormat* foreign_by_name(const std::string& name);

}  // namespace bihive
