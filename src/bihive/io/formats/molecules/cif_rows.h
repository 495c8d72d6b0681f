// The small tables of mmCIF files that state more than atoms: assemblies, connections, title and entry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bihive/io/assemble/assemblies.h"

namespace bihive {

/// A row: values without quotes by tags in lower case. Missing ones are empty.
using CifRow = std::unordered_map<std::string, std::string>;

/// Takes tags and values in the order in which the grammar meets them, and keeps the rows of _pdbx_struct_assembly_gen,
/// _pdbx_struct_oper_list, _struct_conn and _chem_comp_bond, _struct.title and _entry.id, whether they stand in loops
/// or as pairs.
class CifRows {
 public:
  void begin_loop();
  void add_loop_tag(std::string_view tag);
  void add_loop_value(std::string_view value);
  void add_pair_tag(std::string_view tag);
  void add_pair_value(std::string_view value);
  /// Before another block.
  void clear();

  /// Pairs that follow each other are one row; it comes last. The values of all tables in it have different tags.
  const std::vector<CifRow>& rows();

 private:
  std::vector<std::string> fields_;  // of the loop; empty texts for all others
  std::size_t column_ = 0;
  bool ours_ = false;
  CifRow row_, pairs_;
  std::string pair_field_;
  std::vector<CifRow> rows_;
};

/// The value of a tag in the first row that has it; empty: none has.
std::string value_in(const std::vector<CifRow>& rows, const std::string& tag);

/// The assemblies that the rows state.
Assemblies assemblies_from(const std::vector<CifRow>& rows);

}  // namespace bihive
