// The assemblies of PDB files: REMARK 350 [wwPDB-3.3].
#pragma once

#include <string_view>

#include "bihive/io/assemble/assemblies.h"

namespace bihive {

/// Takes the lines of REMARK 350 one after the other.
class PdbAssemblies {
 public:
  void add_line(std::string_view line);
  /// What the lines stated; leaves nothing behind. Operators have running numbers as ids.
  Assemblies take();

 private:
  void add_chains(std::string_view list);
  void add_matrix_row(std::string_view words);
  void end_part();

  Assemblies assemblies_;
  AssemblyPart part_;  // that the lines are about
};

}  // namespace bihive
