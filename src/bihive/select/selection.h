// A subset of spheres by an expression: "chain A and not water", "within 5 of resname LIG", "charge < 0".
//
// docs/selections.md describes the language.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// One byte for each sphere: 1 if the expression selects it, 0 if not. Lengths are in world units; bonds are
/// automatic_bonds() of io/bonds.h. The work is at most O(n log n) for each part of the expression. Distances know the
/// images of a periodic cell (geometry/lattice.h).
///
/// An error has line and column in the expression, counted from 1 in characters; its message says what was expected or
/// which name is unknown, and its hint what there is. caret_lines() shows the place.
Result<std::vector<std::uint8_t>> select_spheres(const SphereSet& spheres, std::string_view expression);

/// Success if the text is an expression, for whatever set.
Status check_selection(std::string_view expression);

/// Whether the spheres that the expression selects depend on a distance, which sees the images of the set's cell.
bool sees_images(const SphereSet& spheres, std::string_view expression);

/// Why a selection finds nothing: the first test of texts or numbers in it that no sphere passes, and what there is
/// instead: "no sphere has chain 'a'; there are A, B". Empty if every test finds some sphere, or the expression is
/// wrong.
std::string what_there_is(const SphereSet& spheres, std::string_view expression);

/// The expression's line in which the error is, and below it a caret at its column: two lines, each indented by two
/// blanks and with its line end. Control characters are replaced. Empty if the error has no column.
std::string caret_lines(std::string_view expression, const Error& error);

}  // namespace bihive
