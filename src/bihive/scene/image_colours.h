// Colours of images by their own positions: `colour-by z` runs over all copies, of which only one is stored.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/math/vec3.h"
#include "bihive/scene/scene.h"
#include "bihive/select/attribute_names.h"

namespace bihive {

class ImageColours {
 public:
  /// The scene must outlive it.
  explicit ImageColours(const Scene& scene);

  /// Whether the colour of some image differs from that of its stored sphere.
  bool any() const { return any_; }

  /// The colour of a sphere of any id; the scene's spheres must have colours. Linear RGB.
  Vec3f colour(std::int64_t id) const;

 private:
  const Scene& scene_;
  std::vector<FoundAttribute> by_place_;  // for each of the scene's `coloured_by`; without numbers: not by position
  bool any_ = false;
};

}  // namespace bihive
