// Rows that say by a column `id` which sphere they are, in any order: LAMMPS writes them as its processors hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/geometry/sphere_attributes.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// What the ids of a file's rows say about their order.
struct IdOrder {
  RowIds kind = RowIds::none;
  std::vector<std::int64_t> rows;  ///< `sorted`: the file's row of each sphere, from 0
  double repeated_id = 0;          ///< `repeated`: the first row whose id another row before it has, and that row
  std::int64_t repeated_at = 0, repeated_from = 0;
};

/// Of ids that increase: one pass over them. `none`: not all are finite.
IdOrder order_of_ids(const std::vector<double>& ids);

/// The values in the order of the rows.
template <class T>
void put_in_order(std::vector<T>& values, const std::vector<std::int64_t>& rows) {
  std::vector<T> sorted;
  sorted.reserve(rows.size());
  for (const std::int64_t row : rows) sorted.push_back(std::move(values[static_cast<std::size_t>(row)]));
  values = std::move(sorted);
}
/// The same for texts; distinct ones are then in order of appearance again.
void put_in_order(TextCollector& texts, const std::vector<std::int64_t>& rows);

/// Notes the order: RawSpheres::ids, a rule where the rows were sorted, and a warning where an id stands twice.
/// `first_line`: of the first row in a text that has a line for each, without blank ones; nothing: rows are counted
/// from 0.
void note_id_order(const IdOrder& order, const std::string& file, std::optional<std::int64_t> first_line,
                   RawSpheres& spheres);

}  // namespace bihive
