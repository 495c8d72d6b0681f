// Sticks between listed pairs of spheres (geometry/stick_set.h).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/links.h"

namespace bihive {

/// The rows of a table of pairs.
struct LinkTable {
  std::vector<std::array<std::int64_t, 2>> pairs;  ///< input_id() of both spheres
  std::vector<std::array<std::int64_t, 3>>
      images;  ///< of the second: it is moved by these multiples of the cell's vectors; empty: the nearest counts
  std::vector<std::pair<std::string, std::vector<double>>> columns;  ///< all other columns; NaN: an empty field
};

/// From CSV text whose first line names the columns: first and second (or the first two), from 0; image_a, image_b and
/// image_c, as `bihive measure --contacts` writes them; and numbers. Lines that begin with # do not count. `file` is
/// for errors, which name the line.
Result<LinkTable> links_from_csv(std::string_view text, const std::string& file);

struct AddedLinks {
  std::int64_t count = 0;
  std::int64_t unknown = 0;  ///< without a stick, because the number that would be its radius is unknown
};

/// Adds to Scene::sticks a stick between the spheres of each pair that are shown, in a periodic cell as two stubs where
/// the second is an image. Either half belongs to the sphere at its end. A radius of 0 draws none. Adds to
/// Scene::sticks_coloured_by how a column colours them. Errors: a sphere that is not in the input, a pair of one sphere
/// with itself, an image where there is no cell; a negative radius; a column that is not there (with what there is); as
/// StickSet::add() and check_sticks().
Result<AddedLinks> add_links(Scene& scene, const LinkTable& table, const Links& links);

}  // namespace bihive
