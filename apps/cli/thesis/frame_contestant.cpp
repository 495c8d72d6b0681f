#include "thesis/frame_contestant.h"

#include <utility>

#include "bihive/base/timer.h"
#include "support/failure.h"

namespace bihive::cli::thesis {
namespace {

// Time between two checks of the cancel token.
constexpr double kSliceMs = 100;

class OnCpu : public Contestant {
 public:
  using Contestant::Contestant;

  double draw(const RenderSettings& settings, const CancelToken& cancel) override {
    const Result<Rendered> rendered = render(scene(), tracer(), settings, {}, &cancel);
    if (cancel.cancelled()) return 0;
    if (!rendered) fail(rendered.error());
    return rendered->render_ms;
  }
};

class OnGpu : public Contestant {
 public:
  OnGpu(std::string name, const Scene& scene, Tracer tracer, std::shared_ptr<Gpu> gpu)
      : Contestant(std::move(name), scene, std::move(tracer)), gpu_(std::move(gpu)) {}

  void prepare() override { must(gpu_->renderer.set_scene(scene(), tracer().tree())); }

  double draw(const RenderSettings& settings, const CancelToken& cancel) override {
    const Timer timer;
    must(gpu_->renderer.begin(scene().camera, settings));
    while (!gpu_->renderer.finished() && !cancel.cancelled()) must(gpu_->renderer.advance(kSliceMs));
    return timer.elapsed_ms();
  }

 private:
  static void must(const Status& status) {
    if (!status) fail_environment(status.error());
  }

  std::shared_ptr<Gpu> gpu_;
};

}  // namespace

Result<std::shared_ptr<Gpu>> Gpu::open() {
  Result<EglContext> context = EglContext::create();
  if (!context) return context.error();
  Result<GlRenderer> renderer = GlRenderer::create(context->functions());
  if (!renderer) return renderer.error();
  return std::make_shared<Gpu>(Gpu{std::move(*context), std::move(*renderer)});
}

ContestantMaker cpu_contestants() {
  return [](const std::string& name, const Scene& scene, Tracer tracer) -> std::unique_ptr<Contestant> {
    return std::make_unique<OnCpu>(name, scene, std::move(tracer));
  };
}

ContestantMaker gpu_contestants(std::shared_ptr<Gpu> gpu) {
  return [gpu = std::move(gpu)](const std::string& name, const Scene& scene,
                                Tracer tracer) -> std::unique_ptr<Contestant> {
    return std::make_unique<OnGpu>(name, scene, std::move(tracer), gpu);
  };
}

}  // namespace bihive::cli::thesis
