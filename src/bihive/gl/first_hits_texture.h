// The first hits of one sample of every pixel, for outlines (shaders/first_hits.glsl): four integers per pixel, with a
// border of pixels around the picture.
#pragma once

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"

namespace bihive {

/// `functions` belong to a context that must be current in every call.
class FirstHitsTexture {
 public:
  explicit FirstHitsTexture(const GlFunctions& gl) : gl_(&gl) {}

  /// Error: the context has no room for it.
  Status resize(int width_px, int height_px);
  void destroy();

  /// Makes it the target of draws, all of it.
  void draw_into() const;
  GLuint texture() const { return texture_; }
  /// Waits until everything is drawn.
  void wait() const;

 private:
  const GlFunctions* gl_;
  int width_ = 0, height_ = 0;
  GLuint texture_ = 0, framebuffer_ = 0;
};

}  // namespace bihive
