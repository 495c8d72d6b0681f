// The sampling patterns of a pixel, the same as the CPU's: positions in the pixel and on the lens, directions of
// ambient occlusion, points of lights.
#pragma once

#include <vector>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/gl/program.h"
#include "bihive/scene/lens_pattern.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// Directions and points are texels of RGBA32F, one set after the other, laid out as in gl/tree_textures.h. The
/// functions' context must be current in every call.
class SampleTextures {
 public:
  explicit SampleTextures(const GlFunctions& gl) : gl_(&gl) {}

  /// Sets up a picture. `soft_light`: some light has a radius; `scale`: stored units per world unit.
  void set(const RenderSettings& settings, bool soft_light, double scale);
  void destroy();

  const CameraSample& camera_sample(int sample) const { return camera_[static_cast<std::size_t>(sample)]; }
  /// Binds the textures to units `first_unit` and the next one, and sets the uniforms of a sample in the program in
  /// use.
  void put(GlProgram& program, int sample, int first_unit) const;

 private:
  // Sets in one texture, level after level (scene/faint_level.h); sample i takes set i modulo their number.
  struct Sets {
    GLuint texture = 0;
    int size = 0, count = 1;  // size 0: none
  };
  void upload(const std::vector<float>& rgba, Sets& sets) const;

  const GlFunctions* gl_;
  std::vector<CameraSample> camera_;
  Sets directions_, light_points_;
  float ambient_distance_ = 0;
};

}  // namespace bihive
