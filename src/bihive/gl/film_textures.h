// The film on the GPU: two textures of the same size, so that a pass reads what the pass before wrote.
//
// A texel is four numbers of binary32. Some contexts cannot draw into textures of floating point (WebGL2 without
// EXT_color_buffer_float, some phones). There a texel holds the bits of the numbers as integers, which every context
// can draw. So pictures are the same to the last bit, which binary16 could not guarantee. FILM_OF_BITS tells the
// shaders (shaders/film_texel.glsl).
#pragma once

#include <array>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// `functions` belong to a context that must be current in every call.
class FilmTextures {
 public:
  explicit FilmTextures(const GlFunctions& gl) : gl_(&gl) {}

  /// Finds out whether the context can draw into floating point, or only into bits. Error: neither.
  Status choose_format();
  /// The format of another film of the same context.
  void take_format(const FilmTextures& other) { format_ = other.format_; }
  /// Error: the context has no room for the film.
  Status resize(int width_px, int height_px);
  void destroy();

  int width() const { return width_; }
  int height() const { return height_; }
  bool of_bits() const { return format_ == GL_RGBA32UI; }

  /// Makes texture `index` (0 or 1) the target of draws, all of it.
  void draw_into(int index) const;
  void fill(int index, Vec3f colour) const;
  GLuint texture(int index) const { return textures_[static_cast<std::size_t>(index)]; }
  /// Rows y0 to y1 - 1 of a texture, four numbers per pixel. Waits until they are drawn.
  void read(int index, int y0, int y1, std::vector<float>& rgba) const;
  /// Waits until everything is drawn. It reads a pixel, because glFinish() may return early in a browser.
  void wait(int index) const;

 private:
  bool make(GLint format, int width_px, int height_px);
  void read_pixels(int y0, int width, int height, float* rgba) const;

  const GlFunctions* gl_;
  GLint format_ = GL_RGBA32F;
  int width_ = 0, height_ = 0;
  std::array<GLuint, 2> textures_{}, framebuffers_{};
};

/// Binds a new texture for texelFetch() alone: no filter, no mipmap.
GLuint make_texture(const GlFunctions& gl);

}  // namespace bihive
