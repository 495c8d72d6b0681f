#include "bihive/render/memory.h"

#include <algorithm>

#include "bihive/base/memory.h"
#include "bihive/base/readable.h"
#include "bihive/bih/memory.h"
#include "bihive/wide/wide_builder.h"

namespace bihive {

Status check_tree_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters) {
  if (is_brute(engine)) return Done{};
  const std::int64_t bytes = engine == Engine::reference
                                 ? predict_tree_memory(spheres.size(), parameters.for_reference()).allocated_bytes.low
                                 : predict_wide_memory(spheres.size(), parameters.for_wide(spheres.size())).low_bytes;
  return check_memory(static_cast<double>(bytes), "the tree of " + grouped(spheres.size()) + " spheres");
}

Status check_picture_memory(int width_px, int height_px) {
  const double pixels = static_cast<double>(width_px) * height_px;
  return check_memory(pixels * (sizeof(Vec3f) + 2 * 3), "so large a picture");
}

int rows_of_band(int rows, double bytes_of_row) {
  constexpr int kRowsOfTiles = 64;
  const double fitting = std::min(kBandBytes, memory_bytes() / 4) / bytes_of_row;
  if (fitting >= rows) return rows;
  const int band = std::max(static_cast<int>(fitting), 1);
  return band < kRowsOfTiles ? band : band / kRowsOfTiles * kRowsOfTiles;
}

}  // namespace bihive
