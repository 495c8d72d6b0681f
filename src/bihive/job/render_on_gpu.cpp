#include "bihive/job/render_on_gpu.h"

#include <utility>

#include "bihive/base/timer.h"
#include "bihive/gl/egl_context.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/job/failure.h"

namespace bihive {
namespace {

// Time between two checks of the progress and of Ctrl-C.
constexpr double kSliceMs = 100;

template <class T>
T from_environment(Result<T> result) {
  if (!result) fail_environment(result.error());
  return std::move(*result);
}

}  // namespace

GpuPicture render_on_gpu(const Scene& scene, const Tree* tree, const RenderSettings& settings,
                         const ProgressCallback& progress) {
  const EglContext context = from_environment(EglContext::create());
  GlRenderer renderer = from_environment(GlRenderer::create(context.functions()));
  from_environment(renderer.set_scene(scene, tree));
  const Timer timer;
  from_environment(renderer.begin(scene.camera, settings));
  while (!renderer.finished()) {
    from_environment(renderer.advance(kSliceMs));
    progress(renderer.done());
  }
  GlRenderer::Picture read = from_environment(renderer.read());
  GpuPicture picture;
  picture.render_ms = timer.elapsed_ms();
  picture.film = std::move(read.film);
  picture.primary = read.primary;
  picture.others = read.others;
  picture.gpu = renderer.description();
  return picture;
}

}  // namespace bihive
