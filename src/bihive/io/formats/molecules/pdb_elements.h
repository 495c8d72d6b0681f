// The elements of atoms in PDB, PQR and GRO files.
//
// Columns 77 and 78 of PDB state them; many files leave those empty, and PQR and GRO have none. Then the residue tells:
// standard residues hold few elements, and ions have names of their own. Only then the columns of the atom's name
// count, and only in files that keep to them: several programs write every name from column 13 on, where "CA" would be
// calcium.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/io/raw_spheres.h"
#include "bihive/io/residue_class.h"

namespace bihive {

/// A file's words on an atom's element.
struct ElementClues {
  std::string_view stated;   ///< columns 77 and 78
  std::string_view name;     ///< columns 13 to 16 with their blanks, or the bare name
  std::string_view residue;  ///< the residue's name, without blanks; behind three letters the chain may follow
  std::string_view place;    ///< names the residue: neighbours with the same text are of one
  std::int64_t line_number;
};

class PdbElements {
 public:
  /// `names_in_columns`: false where a name's place on the line means nothing (PQR, GRO).
  explicit PdbElements(bool names_in_columns) : names_in_columns_(names_in_columns) {}

  /// The next atom.
  void add(const ElementClues& clues);

  /// Gives all atoms their elements (0: unknown). A warning with a count says where the file contradicts itself.
  void take(RawSpheres& spheres, const std::string& file);

 private:
  // An atom that neither its columns nor its residue decides.
  struct Undecided {
    std::size_t index;
    std::size_t residue;  // position in residue_sizes_
    char name[4];
  };

  static std::optional<int> element_in(ResidueClass residue_class, std::string_view residue, std::string_view name);
  void count_evidence(const ElementClues& clues, std::optional<int> element);
  void end_residue();

  bool names_in_columns_;
  std::vector<std::uint8_t> elements_;
  std::vector<Undecided> undecided_;
  std::vector<std::size_t> residue_sizes_;  // of residues with undecided atoms
  std::string place_, residue_;             // of the present residue
  ResidueClass class_ = ResidueClass::unknown;
  std::size_t residue_size_ = 0;
  bool residue_undecided_ = false;
  std::int64_t flush_left_ = 0,
               in_columns_ = 0;  // names that begin in column 13 though they should not; that do as they should
  std::int64_t contradictions_ = 0, first_contradiction_ = 0;
  std::string contradiction_;
};

}  // namespace bihive
