#include "frames/frame.h"

#include <algorithm>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/math/quartiles.h"

namespace bihive::bench {
namespace {

RenderSettings settings_of(int width_px, int height_px, int recursion, bool shadows, int threads) {
  RenderSettings settings;
  settings.width_px = width_px;
  settings.height_px = height_px;
  settings.samples_per_pixel = 1;
  settings.recursion = recursion;
  settings.shadows = shadows;
  settings.threads = threads;
  return settings;
}

}  // namespace

RenderSettings whole_picture(int threads, int side_px) {
  return settings_of(side_px, side_px, 5, true, threads);
}

RenderSettings thesis_frame(int threads) {
  return settings_of(1136, 640, 1, false, threads);
}

double FrameTimes::render_ms() const {
  std::vector<double> values;
  for (const FrameMs& frame : times) values.push_back(frame.render);
  return median(values);
}

double FrameTimes::all_ms() const {
  std::vector<double> values;
  for (const FrameMs& frame : times) values.push_back(frame.all());
  return median(values);
}

void add_frame(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, FrameTimes& times) {
  const Timer render_timer;
  Result<Rendered> result = render(scene, tracer, settings, {}, nullptr, std::move(times.film));
  Rendered& rendered = *result;
  const double render_ms = render_timer.elapsed_ms();
  const Timer byte_timer;
  const Image image = image_from_film(rendered.film, settings.view, scene.picture.transfer, settings.threads);
  times.times.push_back({render_ms, byte_timer.elapsed_ms()});
  times.rays = rendered.rays;
  times.hash = picture_hash(image);
  times.film = std::move(rendered.film);
}

}  // namespace bihive::bench
