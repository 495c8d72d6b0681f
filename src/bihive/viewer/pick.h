// Picking: the sphere seen at a position in the picture, with its attributes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/math/vec3.h"
#include "bihive/scene/scene.h"

namespace bihive {

struct Picked {
  std::int64_t sphere = -1;  ///< its id in the shown set
  Vec3d point;               ///< on its surface, in world units
  double distance = 0;       ///< from the eye, in world units
};

/// The shown sphere of an id of the input (input_id()), copies included; nothing if it is hidden, or there is none.
std::optional<std::int64_t> shown_id(const Scene& scene, std::int64_t id_in_input);

/// {"sphere": id, "point": [x,y,z], "distance": d, "centre": [x,y,z], "radius": r, "attributes": {name: number, text or
/// null}}: the attributes are those that selections know by name, but for place and radius. Elements and
/// types with labels are texts.
std::string picked_to_json(const Picked& picked, const Scene& scene);

}  // namespace bihive
