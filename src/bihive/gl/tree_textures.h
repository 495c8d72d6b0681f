// The layout in textures of spheres, their looks (materials), lights and the tree. Only this file packs them;
// shaders/textures.glsl reads them, and bih/tree.h says what the numbers mean.
//
// Entry i of a texture is the texel (i mod 2048, i / 2048). All is binary32 in stored units (geometry/sphere_set.h).
//
//   spheres      RGBA32F  a texel per sphere, in leaf order and within a leaf in the order of ids (without a tree
//                         in that order altogether): centre, radius
//   sphere_info  RGBA32UI a texel per sphere: id in the input, look, group of creases, the bits of its own outline's
//                         width (-1: none)
//   nodes        RG32UI   two texels per node: the bits of left_clip, right_clip;
//                         kind (bits 0-2), split_axis (bits 3-4), sphere_count (bits 5-31); first
//   looks        RGBA32F  four texels per look: colour, ambient; diffuse, reflective, specular, power; transmissive,
//                         refraction_index, tint, glow; bands, what it transmits once to viewing rays, to shadow rays
//                         (render/transparency.h), 0. Look 0 is the plane's; of the others no two are equal.
//   lights       RGBA32F  two texels per light: position, radius; colour, 0
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/scene/scene.h"

namespace bihive {

constexpr int kTextureWidth = 2048;

/// The texels of one texture row by row, filled up with zeros to whole rows; at least one row.
template <class Channel, int kChannels>
struct Texels {
  static constexpr int kPerTexel = kChannels;
  std::vector<Channel> channels;

  int width() const { return kTextureWidth; }
  int height() const { return static_cast<int>(channels.size() / (std::size_t{kTextureWidth} * kChannels)); }
};

struct SceneTextures {
  std::int64_t sphere_count = 0, node_count = 0, look_count = 0, light_count = 0;
  /// The most nodes with two children on any path from the root to a leaf: as many may wait during a traversal.
  int most_waiting = 0;
  Texels<float, 4> spheres;
  Texels<std::uint32_t, 4> sphere_info;
  Texels<std::uint32_t, 2> nodes;
  Texels<float, 4> looks;
  Texels<float, 4> lights;
};

/// `tree` may be null. Error: the data does not fit a texture of `most_rows` rows.
Result<SceneTextures> pack_scene(const Scene& scene, const Tree* tree, int most_rows);

/// The lights alone; everything else stays empty.
Result<SceneTextures> pack_lights(const Scene& scene, int most_rows);

/// The texels that the shader reads, for tests.
struct PackedSphere {
  float x, y, z, r;
  std::uint32_t id, look;
  std::int32_t group;
  float outline_px;
};
PackedSphere unpack_sphere(const SceneTextures& textures, std::int64_t position);
Node unpack_node(const SceneTextures& textures, std::int64_t position);
Material unpack_look(const SceneTextures& textures, std::int64_t look);

}  // namespace bihive
