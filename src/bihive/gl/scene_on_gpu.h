// A scene in textures, and the programs that draw it.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

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

  /// Makes programs draw into a film of bits (gl/film_textures.h).
  void set_film_of_bits(bool film_of_bits) { film_of_bits_ = film_of_bits; }

  /// As GlRenderer::set_scene().
  Status set(const Scene& scene, const Tree* tree);
  /// As GlRenderer::set_lights().
  Status set_lights(const Scene& scene);
  void destroy();

  bool is_set() const { return textures_[0] != 0; }
  bool has_tree() const { return has_tree_; }
  double scale() const { return scale_; }
  Vec3d origin() const { return origin_; }
  Vec3f background() const { return uniforms_.background; }
  bool has_bands() const { return has_bands_; }
  int light_count() const { return uniforms_.light_count; }

  bool has_soft_light() const { return has_soft_light_; }
  /// Whether some sphere transmits light, and whether one does so straight.
  bool lets_light_through() const { return lets_light_through_; }
  bool is_passed_straight() const { return is_passed_straight_; }
  /// The spheres' own outlines: whether there are any, their largest width (0: none has one), and creases.
  bool has_own_lines() const { return has_own_lines_; }
  float widest_outline_px() const { return widest_outline_px_; }
  bool has_creases() const { return has_creases_; }
  /// The least and the largest depth of a point of the spheres, in stored units, along `forward` from `eye` (of the
  /// world), as fog takes them (render/picture/post_processing.h).
  std::pair<double, double> depths(Vec3d eye, Vec3d forward) const;

  /// Links the program of a view, or of another step, at its first use. `layers`: OpacityRule::once counts; `ambient`:
  /// with ambient occlusion. The pointer lives until destroy(). Error: the shader is refused.
  Result<GlProgram*> program_for(View view, int recursion, bool layers, bool ambient);
  Result<GlProgram*> program_for_distance_range();
  Result<GlProgram*> program_for_first_hits(bool layers);
  Result<GlProgram*> program_for_coverage(bool layers);
  /// Binds the textures, from texture unit 1 on, and sets every uniform of the scene in the program in use.
  void put(GlProgram& program) const;

 private:
  Result<GlProgram*> program(const std::string& chunk, std::vector<std::string> defines);

  const GlFunctions* gl_;
  std::array<GLuint, 5> textures_{};
  SceneUniforms uniforms_;
  bool has_tree_ = false, film_of_bits_ = false;
  bool has_soft_light_ = false, lets_light_through_ = false, is_passed_straight_ = false;
  bool has_own_lines_ = false, has_creases_ = false, has_bands_ = false;
  float widest_outline_px_ = 0;
  std::vector<float> centres_and_radii_;  // in stored units, for depths()
  int stack_size_ = 0;
  double scale_ = 1;
  Vec3d origin_;
  std::map<std::string, GlProgram> programs_;  // by chunk and defines
};

}  // namespace bihive
