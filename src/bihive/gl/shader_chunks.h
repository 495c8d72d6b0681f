// The GLSL chunks embedded in the library: gl/shaders/NAME.glsl for each NAME.
#pragma once

#include <optional>
#include <string_view>

namespace bihive {

/// X(name) for each. A new file in gl/shaders needs its line here; CMake embeds every file of the folder.
#define BIHIVE_SHADER_CHUNKS(X) \
  X(brute_force)                \
  X(camera)                     \
  X(common)                     \
  X(coverage)                   \
  X(distance_range)             \
  X(elementary)                 \
  X(faint_level)                \
  X(film)                       \
  X(film_texel)                 \
  X(first_hits)                 \
  X(hit)                        \
  X(integrator)                 \
  X(pairs)                      \
  X(post_processing)            \
  X(probe_loops)                \
  X(ray)                        \
  X(sample)                     \
  X(scene_hit)                  \
  X(shading)                    \
  X(show)                       \
  X(sphere)                     \
  X(surface)                    \
  X(textures)                   \
  X(tone)                       \
  X(tracer)                     \
  X(transparency)               \
  X(traversal)                  \
  X(triangle)                   \
  X(view_first_hit)             \
  X(view_recursion)             \
  X(view_shaded)                \
  X(view_traversal)

#define BIHIVE_SHADER_CHUNK(name) std::string_view shader_chunk_##name();
BIHIVE_SHADER_CHUNKS(BIHIVE_SHADER_CHUNK)
#undef BIHIVE_SHADER_CHUNK

/// The text of a chunk; nothing if no chunk has that name.
std::optional<std::string_view> shader_chunk(std::string_view name);

}  // namespace bihive
