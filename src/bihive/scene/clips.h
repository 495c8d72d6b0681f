// Clips of a scene: shapes that cut its spheres open. The option --clip of `bihive render`, and the keys `clip` and
// `clips` of scene files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/clip.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/scene.h"

namespace bihive {

class CutSet;

/// "plane:NX,NY,NZ,D", "box:X0,Y0,Z0,X1,Y1,Z1" (any two opposite corners) or "sphere:X,Y,Z,R". Error: the text is none
/// of these; the message says what was expected.
Result<Clip> clip_from_text(const std::string& text);

/// Error: a number is not finite or beyond 3.4e38, a normal has length 0, a box is flat or its corners are not in
/// order, a radius is not above 0.
Status check_clip(const Clip& clip);

/// Whether a clip acts on some sphere.
bool has_clips(const Scene& scene);

/// The cut spheres and sticks of the scene, whose sets must outlive it; null if the clips neither cut nor remove any.
std::shared_ptr<const CutSet> cut_set_of(const Scene& scene);

/// Those of these stored ids whose spheres are not removed entirely.
std::vector<std::int64_t> remaining_ids(const Scene& scene, const std::vector<std::int64_t>& ids);

/// The spheres that are not removed entirely: for cameras. Cut ones are there with their full radii.
class RemainingSpheres {
 public:
  /// The scene must outlive it.
  explicit RemainingSpheres(const Scene& scene);
  /// The scene's own set if clips remove no sphere, so that large sets are not copied; else a subset, without
  /// attributes.
  const SphereSet& set() const { return part_ ? *part_ : *whole_; }

 private:
  const SphereSet* whole_;
  std::optional<SphereSet> part_;
};

}  // namespace bihive
