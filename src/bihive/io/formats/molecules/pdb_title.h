// What a PDB file is about: HEADER, TITLE, and COMPND of files before 1996 [wwPDB-3.3].
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bihive {

/// Takes the lines before the first atom.
class PdbTitle {
 public:
  void add_line(std::string_view line);

  /// TITLE with its continuation lines; without it COMPND, unless that is a list of molecules. Its letters stay as they
  /// are: most are capitals, and nothing says which were.
  std::string title() const;
  /// Columns 63 to 66 of HEADER, where they hold an id of the Protein Data Bank: a digit and three letters or digits.
  const std::string& entry_id() const { return entry_id_; }

 private:
  std::string joined(const std::vector<std::string>& lines) const;

  std::vector<std::string> title_, compound_;
  std::string entry_id_;
};

}  // namespace bihive
