// The answer to a closest-hit query. The normal is computed later, by the code that needs it.
#pragma once

#include <cstdint>
#include <limits>

#include "bihive/geometry/ray.h"

namespace bihive {

/// Nothing hit: t = +inf and sphere_id = kNothing.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  std::int64_t sphere_id = kNothing;

  bool found() const { return sphere_id != kNothing; }

  /// Takes the candidate if it is nearer. Of equal t the smaller id wins, so the order of tests cannot change the hit.
  void keep_nearer(double candidate_t, std::int64_t candidate_id) {
    if (candidate_t < t || (candidate_t == t && found() && candidate_id < sphere_id)) {
      t = candidate_t;
      sphere_id = candidate_id;
    }
  }
};

}  // namespace bihive
