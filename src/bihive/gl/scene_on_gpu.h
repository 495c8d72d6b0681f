// A scene in textures, and the programs that draw it.
#pragma once

#include <array>
#include <map>
#include <string>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/gl/program.h"
#include "bihive/gl/scene_uniforms.h"
#include "bihive/gl/tree_textures.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// The functions' context must be current in every call.
class SceneOnGpu {
 public:
  explicit SceneOnGpu(const GlFunctions& gl) : gl_(&gl) {}

  /// From now on, programs draw into a film of bits (gl/film_textures.h).
  void set_film_of_bits(bool film_of_bits) { film_of_bits_ = film_of_bits; }

  /// As GlRenderer::set_scene().
  Status set(const Scene& scene, const Tree* tree);
  /// As GlRenderer::set_lights().
  Status set_lights(const Scene& scene);
  void destroy();

  bool is_set() const { return textures_[0] != 0; }
  bool has_tree() const { return has_tree_; }
  double scale() const { return scale_; }
  Vec3f background() const { return uniforms_.background; }

  /// Links the program of a view, or of the range of distances, at its first use. The pointer lives until destroy().
  /// Error: the shader is refused.
  Result<GlProgram*> program_for(View view, int recursion);
  Result<GlProgram*> program_for_distance_range();
  /// Binds the textures, from texture unit 1 on, and puts every uniform of the scene into the program in use.
  void put(GlProgram& program) const;

 private:
  Result<GlProgram*> program(const std::string& chunk, int pending_rays, bool counting);

  const GlFunctions* gl_;
  std::array<GLuint, 5> textures_{};
  SceneUniforms uniforms_;
  bool has_tree_ = false, film_of_bits_ = false;
  int stack_size_ = 0;
  double scale_ = 1;
  std::map<std::string, GlProgram> programs_;  // by chunk and defines
};

}  // namespace bihive
