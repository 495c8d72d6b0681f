// Pictures by the graphics processor, in one context for the whole program.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "bihive/gl/egl_context.h"
#include "bihive/gl/gl_renderer.h"

namespace bihive::test {

class GlPictures {
 public:
  /// Ends the program if there is no EGL, because these tests need it (scripts/setup all).
  static GlPictures& get() {
    static GlPictures pictures;
    return pictures;
  }

  GlRenderer& renderer() { return renderer_; }
  const GlFunctions& functions() const { return context_.functions(); }

  GlRenderer::Picture draw(const Scene& scene, const Tree* tree, const RenderSettings& settings) {
    must(renderer_.set_scene(scene, tree));
    must(renderer_.begin(scene.camera, settings));
    while (!renderer_.finished()) must(renderer_.advance(100));
    return must(renderer_.read());
  }

  template <class T>
  static T must(Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s\n", result.error().to_string().c_str());
    std::exit(3);
  }

 private:
  GlPictures() : context_(must(EglContext::create())), renderer_(must(GlRenderer::create(context_.functions()))) {
    std::printf("OpenGL: %s\n", renderer_.description().c_str());
  }

  EglContext context_;
  GlRenderer renderer_;
};

}  // namespace bihive::test
