// Biological assemblies: which chains of a structure are copied, and where to. PDB files state them in REMARK 350,
// mmCIF files in _pdbx_struct_assembly_gen and _pdbx_struct_oper_list.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

struct RawSpheres;

/// A rotation and a shift: three rows of four numbers; NaN where the file has no number.
struct AssemblyOperator {
  std::string id;
  std::array<double, 12> rows{};
};

/// Chains that are copied by each of some operators.
struct AssemblyPart {
  std::string assembly;             ///< the id of the assembly that it belongs to
  std::string operators;            ///< ids as mmCIF writes them: "1", "1,3", "1-5", "(1-60)", "(P,Q)(1-5)"
  std::vector<std::string> chains;  ///< texts of the column kAssemblyChains
};

/// What a file states, in its order. Readers take it as it is; only expand_assembly() finds faults.
struct Assemblies {
  std::vector<AssemblyOperator> operators;
  std::vector<AssemblyPart> parts;

  /// Without repetition.
  std::vector<std::string> ids() const;
};

/// The column of texts that AssemblyPart::chains mean. The mmCIF reader adds it for files with assemblies, and
/// read_spheres() removes it.
constexpr std::string_view kAssemblyChains = "label_chain";
/// The column of numbers that tells the copies of an assembly apart: 1 for the first.
constexpr std::string_view kAssemblyCopy = "copy";

/// Replaces the spheres by those of an assembly: part by part, operator by operator, chain members in the file's order.
/// All attributes are copied. Of a product "(P)(1)", operator 1 acts first. Errors: the file has no such assembly (the
/// hint lists those that it has), an operator is unknown or no operator, no sphere is in the chains, or too many are.
Status expand_assembly(RawSpheres& spheres, const std::string& id, const std::string& file);

}  // namespace bihive
