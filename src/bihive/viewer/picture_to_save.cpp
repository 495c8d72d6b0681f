#include "bihive/viewer/picture_to_save.h"

#include <utility>

#include "bihive/base/check.h"
#include "bihive/render/draw_labels.h"

namespace bihive {

Result<PictureToSave> PictureToSave::by_cpu(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  Result<SlicedPicture> sliced = SlicedPicture::begin(scene, tracer, settings);
  if (!sliced) return sliced.error();
  PictureToSave picture(scene, settings);
  picture.sliced_ = std::move(*sliced);
  return picture;
}

Result<PictureToSave> PictureToSave::by_gpu(GpuPictures& gpu, const Scene& scene, bool new_lights,
                                            const RenderSettings& settings) {
  if (Status status = gpu.begin(scene, new_lights, settings); !status) return status.error();
  PictureToSave picture(scene, settings);
  picture.gpu_ = &gpu;
  return picture;
}

Status PictureToSave::advance(double budget_ms) {
  if (gpu_ != nullptr) return gpu_->renderer().advance(budget_ms);
  sliced_->advance(budget_ms);
  return Done{};
}

bool PictureToSave::finished() const {
  return gpu_ != nullptr ? gpu_->renderer().finished() : sliced_->finished();
}

double PictureToSave::done() const {
  if (finished()) return 1;
  return gpu_ != nullptr ? gpu_->renderer().done() : sliced_->done();
}

Result<PngPixels> PictureToSave::take() {
  BIHIVE_CHECK(finished());
  const Transfer curve = settings_.view == View::shaded ? scene_->picture.transfer : Transfer::none;
  PngPixels pixels;
  if (gpu_ == nullptr) {
    pixels = png_pixels_from_film(sliced_->take().film, curve, 8);
  } else {
    const Result<GlRenderer::Picture> picture = gpu_->renderer().read();
    if (!picture) return picture.error();
    pixels = png_pixels_from_film(picture->film, curve, 8);
  }
  settings_.labels = possible_labels(*scene_, scene_->camera, settings_);
  draw_labels(pixels, *scene_, settings_);
  return pixels;
}

}  // namespace bihive
