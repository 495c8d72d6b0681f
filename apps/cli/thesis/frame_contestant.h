// Draws frames of one scene repeatedly, on the CPU or on the graphics processor, so that they can be timed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "bihive/base/cancel.h"
#include "bihive/gl/egl_context.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive::cli::thesis {

class Contestant {
 public:
  /// `name` is that of its times; the scene must outlive it.
  Contestant(std::string name, const Scene& scene, Tracer tracer)
      : name_(std::move(name)), scene_(scene), tracer_(std::move(tracer)) {}
  virtual ~Contestant() = default;
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;

  const std::string& name() const { return name_; }
  const Scene& scene() const { return scene_; }

  /// Untimed preparation; call it again after another contestant has drawn.
  virtual void prepare() {}
  /// Draws one frame and returns its milliseconds; any number if cancelled.
  virtual double draw(const RenderSettings& settings, const CancelToken& cancel) = 0;

 protected:
  const Tracer& tracer() const { return tracer_; }

 private:
  std::string name_;
  const Scene& scene_;
  Tracer tracer_;
};

using ContestantMaker =
    std::function<std::unique_ptr<Contestant>(const std::string& name, const Scene& scene, Tracer tracer)>;

/// One context, shared by all contestants of a step.
struct Gpu {
  EglContext context;
  GlRenderer renderer;

  /// Error: there is no EGL, or its context is not sufficient.
  static Result<std::shared_ptr<Gpu>> open();
};

/// By render(), with the tracer's engine.
ContestantMaker cpu_contestants();
/// By GlRenderer, on the tracer's tree, or on every sphere if it has no tree.
ContestantMaker gpu_contestants(std::shared_ptr<Gpu> gpu);

}  // namespace bihive::cli::thesis
