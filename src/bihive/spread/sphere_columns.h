// Serializes everything a scene knows about some of its spheres, for other processes.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/scene/scene.h"
#include "bihive/spread/bytes.h"

namespace bihive {

/// The columns of a whole set. A process without any of its spheres cannot tell from its own arrays.
struct SphereColumns {
  bool element = false, type = false, colour = false, opacity = false, outline = false, crease = false, clips = false;
  bool material = false, meaning = false, input_id = false;  ///< of Scene: material, coloured_by, id_in_input

  /// The columns of a scene with all its spheres.
  static SphereColumns of(const Scene& scene);
};

/// Appends the spheres of these ids to the bytes. `whole_ids`: the id of each sphere in the whole set; empty: the set
/// is whole. For a set with images its stored spheres.
void pack_spheres(const Scene& scene, const SphereColumns& has, const std::vector<std::int64_t>& whole_ids,
                  const std::vector<std::int64_t>& ids, Bytes& bytes);

/// Appends the packed spheres to the scene, whose named columns (SphereAttributes::numbers, texts) must have the names
/// and the distinct texts of the scene that packed, and their ids in the whole set to `whole_ids`.
void append_spheres(ByteReader& packed, const SphereColumns& has, Scene& scene, std::vector<std::int64_t>& whole_ids);

/// The spheres with these ids, in this order. One column after the other, so it needs little memory.
void order_spheres(const std::vector<std::int64_t>& ids, const SphereColumns& has, Scene& scene,
                   std::vector<std::int64_t>& whole_ids);

/// Keeps the first `count` spheres.
void keep_first_spheres(std::int64_t count, const SphereColumns& has, Scene& scene,
                        std::vector<std::int64_t>& whole_ids);

/// The scene without spheres: the names of columns, distinct texts, units and cell stay.
Scene without_spheres(const Scene& scene);

}  // namespace bihive
