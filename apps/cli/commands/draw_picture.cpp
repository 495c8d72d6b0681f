#include "commands/draw_picture.h"

#include <algorithm>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/render_on_gpu.h"
#include "bihive/render/memory.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

// Memory of a row of film and file. Adaptive samples keep their own film, and the set of edge pixels.
double bytes_of_row(const RenderSettings& settings, const PictureFile& file) {
  const double film = sizeof(Vec3f) + (settings.transparent ? sizeof(float) : 0);
  const double pixel = film + (settings.adaptive_samples ? film + 1 : 0) + file.bytes_of_pixel();
  return pixel * drawn_pixels(settings).width();
}

void stop_if_interrupted() {
  if (CancellableSection::token().cancelled()) throw Interrupted{};
}

// Ends the picture if a signal came, else if there is an error.
void succeed_or_leave(const Status& status) {
  stop_if_interrupted();
  if (!status) fail(status.error());
}

Drawn draw_on_cpu(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile& file,
                  const ProgressCallback& progress) {
  const int band_rows = rows_of_band(drawn_pixels(settings).height(), bytes_of_row(settings, file));
  Result<RenderedBands> result = render_in_bands(
      scene, tracer, settings, band_rows,
      [&file](const Film& film, const Tile& pixels) { return file.add(film, pixels); }, progress,
      &CancellableSection::token());
  stop_if_interrupted();
  const RenderedBands rendered = value_or_fail(std::move(result));
  Drawn drawn = drawn_with(rendered.rays);
  drawn.render_ms = rendered.render_ms;
  return drawn;
}

// Layers without light: one ray per pixel.
Drawn draw_layers_alone(const RenderSettings& settings, PictureFile& file, const ProgressCallback& progress) {
  const Timer timer;
  const Tile all = drawn_pixels(settings);
  const int band_rows = rows_of_band(all.height(), bytes_of_row(settings, file));
  for (int y = all.y0; y < all.y1; y += band_rows) {
    succeed_or_leave(file.add({}, {all.x0, y, all.x1, std::min(y + band_rows, all.y1)}));
    progress(static_cast<double>(y - all.y0) / all.height());
  }
  Drawn drawn;
  drawn.all_rays = std::int64_t{all.width()} * all.height();
  drawn.rays = {{"primary", drawn.all_rays}, {"all", drawn.all_rays}};
  drawn.render_ms = timer.elapsed_ms();
  return drawn;
}

Drawn draw_on_gpu(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile& file,
                  const ProgressCallback& progress) {
  GpuPicture picture = render_on_gpu(scene, tracer.tree(), settings, [&](double done) {
    progress(done);
    stop_if_interrupted();
  });
  succeed_or_leave(file.add(picture.film, drawn_pixels(settings)));
  Drawn drawn;
  drawn.all_rays = picture.primary + picture.others;
  drawn.rays = {{"primary", picture.primary}, {"all", drawn.all_rays}};
  drawn.gpu = picture.gpu;
  drawn.render_ms = picture.render_ms;
  return drawn;
}

}  // namespace

Drawn drawn_with(const RenderCounts& rays) {
  Drawn drawn;
  drawn.all_rays = rays.primary + rays.shadow + rays.reflected + rays.transmitted + rays.ambient;
  drawn.rays = {{"primary", rays.primary},         {"shadow", rays.shadow},   {"reflected", rays.reflected},
                {"transmitted", rays.transmitted}, {"ambient", rays.ambient}, {"all", drawn.all_rays}};
  return drawn;
}

Drawn draw_picture(const Scene& scene, const Tracer& tracer, RenderEngine engine, const RenderSettings& settings,
                   const std::vector<Layer>& layers, PictureFile& file, const ProgressCallback& progress) {
  if (!layers.empty() && !has_radiance(layers)) return draw_layers_alone(settings, file, progress);
  if (is_gpu(engine)) return draw_on_gpu(scene, tracer, settings, file, progress);
  return draw_on_cpu(scene, tracer, settings, file, progress);
}

}  // namespace bihive::cli
