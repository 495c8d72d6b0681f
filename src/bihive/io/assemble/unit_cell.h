// Periodic cells as files state them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "bihive/geometry/cell.h"

namespace bihive {

struct ReadOptions;

/// From the lengths a, b, c and the angles alpha, beta, gamma in degrees of a crystal: a along x, b in the plane of x
/// and y, as PDB and mmCIF place their atoms. Nothing: the numbers are no cell.
std::optional<Cell> unit_cell(const std::array<double, 6>& lengths_and_angles);

/// Whether these are the numbers that PDB and mmCIF files without a crystal have: lengths of 1, or of 0.
bool is_placeholder_cell(const std::array<double, 6>& lengths_and_angles);

/// The warning for a frame that states a cell whose numbers make none.
std::string unreadable_cell(std::int64_t frame);

/// The cell of a file as the options of reading want it: its vectors and its corner, and whether distances see images.
/// Nothing: there is no cell.
std::optional<Cell> cell_by_options(const std::optional<Cell>& of_file, const ReadOptions& options);

/// Whether every number is finite.
bool is_finite(const Cell& cell);

}  // namespace bihive
