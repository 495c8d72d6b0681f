#include "bihive/viewer/picture_steps.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "bihive/image/png_pixels.h"
#include "bihive/viewer/shown_image.h"

namespace bihive {
namespace {

// A picture of a moving scene may overrun the budget by this factor; otherwise it might never be shown.
constexpr double kMostBudgets = 4;

// Rays of an intermediate picture. Where pixels share what theirs bring, kSharedSets neighbours have as many directions
// as a usual picture at rest; else there are enough for about the right brightness, though edges of single shadows
// show.
constexpr int kSharedDirections = 4, kQuickDirections = 8;
constexpr int kSharedLightPoints = 1, kQuickLightPoints = 2;

// Pixels share light on one sphere. With fewer pixels than this for each sphere, most would have nobody to share with,
// and few directions of their own are darker than many.
constexpr std::int64_t kPixelsPerSharingSphere = 8;

// Whether the picture has soft light, outlines, fog or a lens, which take more rays.
bool has_slow_parts(const Scene& scene, const RenderSettings& settings) {
  if (scene.camera.aperture > 0) return true;
  return settings.view == View::shaded && (settings.ambient_occlusion || settings.outline || settings.fog ||
                                           has_own_lines(scene) || (has_soft_light(scene) && settings.shadows));
}

// The same picture with fewer rays. An outline keeps its width on the screen: one thinner than a pixel is fainter.
void make_quick(RenderSettings& settings, int divisor, bool shares_light) {
  if (settings.ambient_occlusion)
    settings.ambient_occlusion->directions =
        std::min(settings.ambient_occlusion->directions, shares_light ? kSharedDirections : kQuickDirections);
  settings.light_points = std::min(settings.light_points, shares_light ? kSharedLightPoints : kQuickLightPoints);
  if (shares_light) settings.light_sets = kSharedSets;
  settings.line_scale = settings.line_unit == LineUnit::picture ? 1 : 1.0 / divisor;
}

// For the labels of a picture of any step.
RenderSettings whole_picture(const PictureSubject& subject) {
  return render_settings(subject.settings, subject.size.width, subject.size.height, 1);
}

// Pixels of a picture of that step.
std::int64_t pixels_of(PictureStep step, PictureSizePx size) {
  return std::int64_t{divided(size.width, step.divisor)} * divided(size.height, step.divisor);
}

}  // namespace

void PictureSteps::drop_step() {
  picture_.reset();
  begun_ = false;
}

void PictureSteps::start_anew() {
  drop_step();
  restart_ = true;
}

Result<FrameReport> PictureSteps::frame(const PictureSubject& subject, double budget_ms) {
  const Timer timer;
  FrameReport report;
  if (!at_rest()) {
    if (Status status = go_on(subject, budget_ms, report.drawn); !status) {
      // Report it only once.
      drop_step();
      restart_ = false;
      settled_ = true;
      return status.error();
    }
    if (report.drawn && moving_) rate_.moved(clock_.elapsed_ms());
  }
  const StepShare share = share_of_step(step_, samples_at_rest(subject.settings));
  report.settled = at_rest();
  // A quick step of full size comes before the full one, and counts as its beginning.
  const double own = quick_ && is_last(step_, subject) ? 0 : share.own;
  report.done = report.settled ? 1 : share.before + own * done_of_step(subject);
  report.divisor = step_.divisor;
  report.frame_ms = timer.elapsed_ms();
  report.fps = rate_.fps();
  report.mray_per_s = mray_per_s_;
  return report;
}

// One step, or some of it.
Status PictureSteps::go_on(const PictureSubject& subject, double budget_ms, bool& drawn) {
  const PictureSizePx size = subject.size;
  if (restart_ && !(begun_ && moving_)) {
    drop_step();
    restart_ = false;
    settled_ = false;
    moving_ = true;
    const PictureStep first{divisor_for(size.width, size.height, cost(subject), budget_ms), 1};
    if (Status status = begin_step(subject, first); !status) return status;
  } else if (!begun_) {
    moving_ = false;
    const PictureStep next = finer_step(step_, samples_at_rest(subject.settings));
    if (Status status = begin_step(subject, next); !status) return status;
  }

  const Timer timer;
  const double limit_ms = moving_ ? kMostBudgets * budget_ms : budget_ms;
  if (subject.settings.engine == ViewerEngine::gpu) {
    if (Status status = subject.gpu->renderer().advance(limit_ms); !status) return status;
    spent_ms_ += timer.elapsed_ms();
    return take_gpu(subject, drawn);
  }
  picture_->advance(limit_ms);
  spent_ms_ += timer.elapsed_ms();
  take_cpu(subject, drawn);
  return Done{};
}

Status PictureSteps::begin_step(const PictureSubject& subject, PictureStep step) {
  ShownScene& shown = subject.shown;
  step_ = step;
  shown.look_by(subject.settings);
  spent_ms_ = 0;
  shown_samples_ = 0;
  begun_ = true;
  RenderSettings settings = render_settings(subject.settings, divided(subject.size.width, step_.divisor),
                                            divided(subject.size.height, step_.divisor), step_.samples);
  slow_parts_ = has_slow_parts(shown.scene, settings);
  quick_ = slow_parts_ && (moving_ || !is_last(step_, subject));
  const bool shares_light =
      subject.settings.engine == ViewerEngine::cpu && !lets_light_through(shown.scene) &&
      pixels_of(step_, subject.size) / kPixelsPerSharingSphere >= shown.scene.spheres.total_size();
  if (quick_) make_quick(settings, step_.divisor, shares_light);
  if (quick_) shown.scene.camera.aperture = 0;
  if (quick_ || !is_last(step_, subject)) settings.adaptive_samples = false;
  if (subject.settings.engine == ViewerEngine::gpu)
    return subject.gpu->begin(shown.scene, /*new_lights=*/!shown.has_lights, settings);
  const Result<const Tracer*> tracer = shown.trees->needed_by(subject.settings);
  if (!tracer) return tracer.error();
  Result<SlicedPicture> picture = SlicedPicture::begin(shown.scene, **tracer, settings, std::move(film_));
  film_ = {};
  if (!picture) return picture.error();
  picture_ = std::move(*picture);
  return Done{};
}

// The film as the image.
void PictureSteps::put_image(const PictureSubject& subject) {
  const Scene& scene = subject.shown.scene;
  const RenderSettings whole = whole_picture(subject);
  opacity_.clear();
  if (checks_ || film_.coverage.empty()) {
    image_ = image_to_show(film_, subject.settings.view, scene.picture.transfer);
    if (whole.labels.any()) image_ = labelled(std::move(image_), scene, whole);
    return;
  }
  const Transfer curve = subject.settings.view == View::shaded ? scene.picture.transfer : Transfer::none;
  PngPixels pixels = png_pixels_from_film(film_, curve, 8);
  if (whole.labels.any()) pixels = labelled(std::move(pixels), scene, whole);
  const std::size_t count = pixels.bytes.size() / 4;
  image_ = {pixels.width, pixels.height, {}};
  image_.rgb.resize(3 * count);
  opacity_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::copy_n(&pixels.bytes[4 * i], 3, &image_.rgb[3 * i]);
    opacity_[i] = pixels.bytes[4 * i + 3];
  }
}

void PictureSteps::take_cpu(const PictureSubject& subject, bool& drawn) {
  if (!picture_->finished()) return;
  Rendered rendered = picture_->take();
  film_ = std::move(rendered.film);
  put_image(subject);
  const RenderCounts& rays = rendered.rays;
  const auto all = static_cast<double>(rays.primary + rays.shadow + rays.reflected + rays.transmitted + rays.ambient);
  if (rendered.render_ms > 0) mray_per_s_ = all / rendered.render_ms / 1000;
  picture_.reset();
  drawn = true;
  finish_step(subject);
}

Status PictureSteps::take_gpu(const PictureSubject& subject, bool& drawn) {
  GpuPictures& gpu = *subject.gpu;
  drawn = gpu.renderer().samples_done() > shown_samples_;
  if (drawn)
    if (Status status = gpu.keep(subject.shown.scene, whole_picture(subject)); !status) return status;
  shown_samples_ = gpu.renderer().samples_done();
  if (!gpu.renderer().finished()) return Done{};
  const double primary = static_cast<double>(pixels_of(step_, subject.size)) * step_.samples;
  finish_step(subject);

  // The number of rays of other kinds is read at rest only, because that reads the picture back.
  if (settled_) {
    const Result<GlRenderer::Picture> picture = gpu.renderer().read();
    if (!picture) return picture.error();
    rays_per_primary_ = static_cast<double>(picture->primary + picture->others) / primary;
  }
  if (spent_ms_ > 0) mray_per_s_ = primary * rays_per_primary_ / spent_ms_ / 1000;
  return Done{};
}

void PictureSteps::finish_step(const PictureSubject& subject) {
  // Moving pictures have one sample per pixel, and are quick.
  const bool last = is_last(step_, subject);
  if (step_.samples == 1 && quick_ == slow_parts_) cost(subject).measured(spent_ms_, pixels_of(step_, subject.size));
  begun_ = false;
  settled_ = last && !quick_;
}

double PictureSteps::done_of_step(const PictureSubject& subject) const {
  if (!begun_) return 1;
  if (subject.settings.engine == ViewerEngine::gpu) return subject.gpu->renderer().done();
  return picture_ ? picture_->done() : 0;
}

}  // namespace bihive
