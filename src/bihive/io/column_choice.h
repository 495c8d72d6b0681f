// Which column of a file plays which part, where its name does not say it.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// From the part to the column: the column's name, else its place from 1. Parts are x, y, z, r (or radius), diameter,
/// element, atomic_number, type, red, green, blue, opacity and transparency; any other one is the name under which the
/// column's numbers or texts are kept. docs/formats.md#columns
using ColumnChoice = std::map<std::string, std::string>;

/// The names of the column that tells molecules apart, as programs write it; the first that is there counts.
inline constexpr std::array<std::string_view, 4> kMoleculeColumns{"mol", "molecule", "mol_id", "molecule_id"};

/// From "x=px,y=py,z=pz,r=5". Errors: a part twice, an empty part or column.
Result<ColumnChoice> columns_from_text(std::string_view text);

}  // namespace bihive
