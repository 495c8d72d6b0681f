// Vectors from text.
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// "X,Y,Z", each number in [least, most].
inline std::optional<Vec3d> vector_from_text(std::string_view text,
                                             double least = std::numeric_limits<double>::lowest(),
                                             double most = std::numeric_limits<double>::max()) {
  const std::vector<double> numbers = numbers_from_text(text);
  if (numbers.size() != 3) return std::nullopt;
  for (const double number : numbers)
    if (!(number >= least && number <= most)) return std::nullopt;
  return Vec3d{numbers[0], numbers[1], numbers[2]};
}

}  // namespace bihive
