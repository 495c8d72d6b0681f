// Arrows on spheres, along vectors that their attributes state.
#pragma once

#include <limits>
#include <string>

namespace bihive {

/// The point of an arrow that is at the centre of its sphere.
enum class ArrowPivot { tail, middle };

struct Arrows {
  std::string components;  ///< three attributes or arithmetic of such: "vx,vy,vz"; empty: no arrows
  std::string select;      ///< a selection (docs/selections.md); empty: all spheres have arrows
  double scale = 1;        ///< length in world units of a vector of length 1, above 0
  double share = 0;        ///< above 0: the longest arrow has this share of the set's longest side, whatever `scale` is
  double radius =
      std::numeric_limits<double>::infinity();  ///< of shafts, world units, above 0; inf: a quarter of the sphere's
  ArrowPivot pivot = ArrowPivot::tail;
  std::string colour;  ///< a colour, or an attribute as colour_by_from_text() takes it; empty: the sphere's

  bool any() const { return !components.empty(); }
};

}  // namespace bihive
