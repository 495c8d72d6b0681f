// Draws pictures in steps, coarse while something moves, ever finer at rest, by either engine.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/timer.h"
#include "bihive/image/film.h"
#include "bihive/image/image.h"
#include "bihive/render/renderer.h"
#include "bihive/viewer/frame_report.h"
#include "bihive/viewer/gpu_pictures.h"
#include "bihive/viewer/orbit.h"
#include "bihive/viewer/pacing.h"
#include "bihive/viewer/shown_scene.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

/// The content of the pictures, and the engines that make them.
struct PictureSubject {
  ShownScene& shown;
  const ViewerSettings& settings;
  PictureSizePx size;
  GpuPictures* gpu;  ///< of ViewerEngine::gpu; null: none is attached
};

class PictureSteps {
 public:
  /// The subject or the size is new: drops the unfinished picture.
  void start_anew();
  /// The camera moved. The first picture after the last move is finished before the next one begins; otherwise a fast
  /// hand would never see a picture.
  void moved() { restart_ = true; }
  /// Call it before the scene, its trees or the GPU's renderer go away or are used for something else. The unfinished
  /// picture releases them, and the next call of go_on() restarts a step.
  void drop_step();
  void forget_image() {
    image_ = {};
    opacity_.clear();
  }
  /// False: instead of grey checks, pictures with a transparent background get opacity.
  void show_checks(bool checks) { checks_ = checks; }

  bool at_rest() const { return settled_ && !restart_; }
  /// As Viewer::frame(). After an Error nothing is drawn until something changes.
  Result<FrameReport> frame(const PictureSubject& subject, double budget_ms);
  /// The last picture of the CPU engine.
  const Image& image() const { return image_; }
  /// One byte for each of its pixels; empty: it is opaque.
  const std::vector<std::uint8_t>& opacity() const { return opacity_; }

 private:
  Status go_on(const PictureSubject& subject, double budget_ms, bool& drawn);
  Status begin_step(const PictureSubject& subject, PictureStep step);
  void put_image(const PictureSubject& subject);
  void take_cpu(const PictureSubject& subject, bool& drawn);
  Status take_gpu(const PictureSubject& subject, bool& drawn);
  void finish_step(const PictureSubject& subject);
  bool is_last(PictureStep step, const PictureSubject& subject) const {
    return step == PictureStep{1, samples_at_rest(subject.settings)};
  }
  double done_of_step(const PictureSubject& subject) const;
  PictureCost& cost(const PictureSubject& subject) {
    return costs_[subject.settings.engine == ViewerEngine::gpu ? 1 : 0];
  }

  // The unfinished picture.
  bool restart_ = false;  // something has changed since the step was begun
  bool settled_ = true;
  bool moving_ = false;      // the step is the first after a change
  bool slow_parts_ = false;  // the picture has soft light, outlines or fog
  bool quick_ = false;       // the step has fewer rays for soft light than the final picture
  bool begun_ = false;
  PictureStep step_;
  std::optional<SlicedPicture> picture_;  // on the CPU
  Film film_;                             // the next picture takes its memory
  Image image_;
  std::vector<std::uint8_t> opacity_;
  bool checks_ = true;
  int shown_samples_ = 0;  // on the graphics processor
  double spent_ms_ = 0;

  // Paces.
  Timer clock_;
  FrameRate rate_;
  PictureCost costs_[2];  // CPU, GPU
  double rays_per_primary_ = 1;
  double mray_per_s_ = 0;
};

}  // namespace bihive
