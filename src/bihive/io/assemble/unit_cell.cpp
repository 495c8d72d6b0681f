#include "bihive/io/assemble/unit_cell.h"

#include <cmath>

#include "bihive/io/read_spheres.h"
#include "bihive/math/elementary.h"

namespace bihive {

std::optional<Cell> unit_cell(const std::array<double, 6>& given) {
  const auto [a, b, c, alpha, beta, gamma] = given;
  for (const double length : {a, b, c})
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  for (const double angle : {alpha, beta, gamma})
    if (!(angle > 0 && angle < 180)) return std::nullopt;
  const SineCosine at_a = sine_cosine_deg(alpha);
  const SineCosine at_b = sine_cosine_deg(beta);
  const SineCosine at_c = sine_cosine_deg(gamma);
  const double y = (at_a.cosine - at_b.cosine * at_c.cosine) / at_c.sine;
  const double z_squared = 1 - at_b.cosine * at_b.cosine - y * y;
  if (!(z_squared > 0)) return std::nullopt;
  Cell cell;
  cell.vectors = {Vec3d{a, 0, 0}, Vec3d{b * at_c.cosine, b * at_c.sine, 0},
                  Vec3d{c * at_b.cosine, c * y, c * std::sqrt(z_squared)}};
  return cell;
}

bool is_placeholder_cell(const std::array<double, 6>& given) {
  const auto all = [&given](double length) { return given[0] == length && given[1] == length && given[2] == length; };
  return all(1) || all(0);
}

std::string unreadable_cell(std::int64_t frame) {
  return "frame " + std::to_string(frame) + ": the numbers of its cell make none, so it is left out";
}

std::optional<Cell> cell_by_options(const std::optional<Cell>& of_file, const ReadOptions& options) {
  std::optional<Cell> cell = of_file;
  if (options.cell_vectors && !cell) cell.emplace();
  if (!cell) return cell;
  if (options.cell_vectors) cell->vectors = *options.cell_vectors;
  if (options.cell_origin) cell->origin = *options.cell_origin;
  if (options.cell_periodic) cell->periodic = *options.cell_periodic;
  if (!options.periodic) cell->periodic = {false, false, false};
  return cell;
}

bool is_finite(const Cell& cell) {
  return is_finite(cell.origin) && is_finite(cell.vectors[0]) && is_finite(cell.vectors[1]) &&
         is_finite(cell.vectors[2]);
}

}  // namespace bihive
