#include "bihive/io/formats/molecules/pdb_assemblies.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::string_view kBiomolecule = "BIOMOLECULE:";
constexpr std::string_view kApply = "APPLY THE FOLLOWING TO CHAINS:";
constexpr std::string_view kAndChains = "AND CHAINS:";
constexpr std::string_view kMatrixRow = "BIOMT";

// The first word, which leaves the text.
std::string_view take_word(std::string_view& text) {
  text = trim(text);
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

}  // namespace

void PdbAssemblies::add_line(std::string_view line) {
  constexpr std::size_t kTextColumn = 11;  // behind "REMARK 350 "
  const std::string_view text = line.size() > kTextColumn ? trim(line.substr(kTextColumn)) : std::string_view();
  if (text.starts_with(kBiomolecule)) {
    end_part();
    part_.assembly = printable(trim(text.substr(kBiomolecule.size())));
  } else if (text.starts_with(kApply)) {
    end_part();
    add_chains(text.substr(kApply.size()));
  } else if (text.starts_with(kAndChains)) {
    add_chains(text.substr(kAndChains.size()));
  } else if (text.starts_with(kMatrixRow)) {
    add_matrix_row(text.substr(kMatrixRow.size()));
  }
}

void PdbAssemblies::add_chains(std::string_view list) {
  for (const std::string_view around : parts_of(list, ','))
    if (const std::string_view chain = trim(around); !chain.empty()) part_.chains.push_back(printable(chain));
}

// "1   2  1.000000  0.000000  0.000000        0.00000": row, number of the operator, four numbers.
void PdbAssemblies::add_matrix_row(std::string_view words) {
  const auto row = parse_int(take_word(words));
  if (!row || *row < 1 || *row > 3) return;
  take_word(words);
  if (*row == 1) {
    AssemblyOperator made;
    made.rows.fill(std::numeric_limits<double>::quiet_NaN());
    made.id = std::to_string(assemblies_.operators.size() + 1);
    part_.operators += (part_.operators.empty() ? "" : ",") + made.id;
    assemblies_.operators.push_back(made);
  }
  if (part_.operators.empty()) return;
  for (std::size_t column = 0; column < 4; ++column)
    if (const auto number = parse_double(take_word(words)))
      assemblies_.operators.back().rows[4 * static_cast<std::size_t>(*row - 1) + column] = *number;
}

// A biomolecule may have several parts.
void PdbAssemblies::end_part() {
  if (!part_.operators.empty() && !part_.chains.empty()) assemblies_.parts.push_back(part_);
  part_.operators.clear();
  part_.chains.clear();
}

Assemblies PdbAssemblies::take() {
  end_part();
  return std::exchange(assemblies_, {});
}

}  // namespace bihive
