// Pictures of the GPU. The last complete one is kept and shown while the next is drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The rules of GlRenderer for contexts hold here too.
class GpuPictures {
 public:
  /// Error: the context cannot do it.
  static Result<std::unique_ptr<GpuPictures>> create(const GlFunctions& functions);
  ~GpuPictures();
  GpuPictures(const GpuPictures&) = delete;
  GpuPictures& operator=(const GpuPictures&) = delete;

  /// The renderer; begin() below starts a picture.
  GlRenderer& renderer() { return renderer_; }
  const GlRenderer& renderer() const { return renderer_; }

  /// Starts a picture of the scene that was set, with the camera and transfer of `scene`, and with its lights if they
  /// are new.
  Status begin(const Scene& scene, bool new_lights, const RenderSettings& settings);

  /// False: instead of grey checks, pictures with a transparent background get opacity.
  void show_checks(bool checks) { checks_ = checks; }

  /// Copies the complete passes, with the labels of `whole`, the settings of the picture in its full size
  /// (viewer/shown_image.h); show() then draws this copy. Error: no room for it.
  Status keep(const Scene& scene, const RenderSettings& whole);
  /// Draws the kept picture, if any, stretched to the viewport.
  void show(std::uint32_t framebuffer, const GlViewport& viewport) const;
  void forget() { width_ = height_ = 0; }

  /// The context is gone: delete nothing.
  void abandon();

 private:
  Status make_room(int width_px, int height_px);
  Status put_labels(const Scene& scene, const RenderSettings& whole);

  GpuPictures(const GlFunctions& gl, GlRenderer renderer) : gl_(gl), renderer_(std::move(renderer)) {}

  GlFunctions gl_;
  GlRenderer renderer_;
  bool abandoned_ = false;
  bool checks_ = true;
  RenderSettings settings_;  // of the unfinished picture
  Transfer transfer_ = Transfer::srgb;
  GLuint texture_ = 0, framebuffer_ = 0;  // of the kept picture
  int width_ = 0, height_ = 0;            // 0: no picture is kept
};

}  // namespace bihive
