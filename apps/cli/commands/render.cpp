// bihive render: draws a picture of an input.

#include <memory>

#include "bihive/base/memory.h"
#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/prepare_picture.h"
#include "commands/commands.h"
#include "commands/draw_on_ranks.h"
#include "commands/draw_picture.h"
#include "commands/picture_file.h"
#include "commands/render_steps.h"
#include "commands/share_picture.h"
#include "support/communicator.h"
#include "support/interrupt.h"
#include "support/say_tuned.h"
#include "support/thread_reserve.h"

namespace bihive::cli {

void run_render(const RenderOptions& asked) {
  const RenderOptions options = with_film(asked);
  if (communicator() != nullptr && communicator()->distributes()) return run_render_spread(options);
  PreparedPicture prepared{};
  if (leads()) {
    prepared = prepare_render(options);
    if (communicator() == nullptr) turn_group_limit_into_failing_allocations();
    check_memory_of(prepared.engine, prepared.input, options, prepared.settings);
  }
  prepared.settings.threads = static_cast<int>(options.threads);
  if (communicator() != nullptr) {
    communicator()->barrier();
    share_picture(prepared, /*with_spheres=*/true, *communicator());
  }
  const Scene& scene = prepared.input.scene;
  const RenderSettings& settings = prepared.settings;

  // Build, render, write.
  const TreeParameters tree = [&] {
    if (!options.tune) return options.tree;
    Progress progress("tuning");
    return say_tuned(scene, prepared.engine, settings, [&](double done) { progress.update(done); });
  }();
  const Tracer tracer = value_or_fail(Tracer::build(scene, structure_of(prepared.engine), tree, settings.threads));
  if (communicator() == nullptr) renew_group_limit_for_threads(settings.threads);
  const Timer drawing;
  const std::unique_ptr<PictureFile> file = leads() ? open_picture({options, scene, tracer, settings, prepared.layers,
                                                                    text_of(options, scene, prepared.described)})
                                                    : nullptr;
  // Nothing may fail between this and the drawing, because the other ranks wait for rank 0 there.
  if (communicator() != nullptr) communicator()->barrier();
  const Drawn drawn = [&] {
    const CancellableSection section;
    Progress progress("rendering");
    const auto update = [&](double done) { progress.update(done); };
    try {
      if (communicator() != nullptr && prepared.can_share)
        return draw_on_ranks(scene, tracer, settings, file.get(), update, *communicator());
      return file == nullptr ? Drawn{}
                             : draw_picture(scene, tracer, prepared.engine, settings, prepared.layers, *file, update);
    } catch (const Interrupted&) {
      CancellableSection::leave_if_cancelled();
      throw;
    }
  }();
  if (communicator() != nullptr) communicator()->barrier();
  if (file == nullptr) return;
  value_or_fail(file->finish());
  const double write_ms = drawing.elapsed_ms() - drawn.render_ms;
  report_render(options, {prepared, tracer.engine(), scene.spheres.size(), tracer.build_ms(), write_ms, drawn, *file});
}

}  // namespace bihive::cli
