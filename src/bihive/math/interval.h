// The interval of a ray inside a node, as parameters of the ray. Never mixed with the ray's own segment t_min, t_max.
#pragma once

namespace bihive {

struct Interval {
  double t_near = 0;
  double t_far = 0;
  bool empty() const { return !(t_near <= t_far); }
};

}  // namespace bihive
