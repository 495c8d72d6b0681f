// Pictures of the steps of primary rays, one for each structure, on one scale.
#pragma once

#include <string>
#include <vector>

#include "bihive/compare/comparison.h"

namespace bihive::cli {

struct CostPicture {
  std::string structure;
  std::string png;  ///< the file's bytes
  double least = 0, mean = 0, most = 0;
};

struct CostPictures {
  std::vector<CostPicture> pictures;  ///< of the structures that have StructureResult::costs
  std::vector<std::string> colours;   ///< of the scale, from 1 step on, as #rrggbb
  std::vector<double> ticks;          ///< powers of ten on it
  double end = 1;                     ///< of the scale, which is logarithmic

  /// The position of a number on the scale, 0 to 1.
  double share(double steps) const;
};

CostPictures cost_pictures(const workbench::Comparison& comparison);

}  // namespace bihive::cli
