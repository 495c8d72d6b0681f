// How the numbers of an attribute are distributed, with the ends of the colours' range, which can be dragged.
#pragma once

#include <string>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive::window {

class ColourRanges {
 public:
  /// Counts the attribute's numbers, once; nothing for one without numbers.
  void update(const SphereSet& spheres, const std::string& attribute);
  /// Other spheres, or other numbers.
  void forget() { attribute_.clear(); }

  /// `range`: "MIN,MAX", or empty for all values. True: an end was dragged.
  bool draw(const std::string& attribute, std::string& range);

 private:
  std::string attribute_;
  double least_ = 0, most_ = 0;
  std::vector<float> heights_;  // of bars; empty: there are no numbers
  int dragged_ = -1;            // the end
};

}  // namespace bihive::window
