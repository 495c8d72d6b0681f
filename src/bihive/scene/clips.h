// Clips of a scene: shapes that cut its spheres open. The option --clip of `bihive render`, and the keys `clip` and
// `clips` of scene files.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

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

/// The clip at another place.
Clip moved(const Clip& clip, Vec3d by);

/// Whether a clip acts on some sphere.
bool has_clips(const Scene& scene);

/// What the clips make of the scene's spheres, which must outlive it; null if they do not cut and do not remove any.
std::shared_ptr<const CutSet> cut_set_of(const Scene& scene);

/// The spheres of which something is left, without attributes: for cameras. Cut ones are there with their full radii.
SphereSet remaining_spheres(const Scene& scene);

}  // namespace bihive
