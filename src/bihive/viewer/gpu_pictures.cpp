#include "bihive/viewer/gpu_pictures.h"

#include <utility>

namespace bihive {

Result<std::unique_ptr<GpuPictures>> GpuPictures::create(const GlFunctions& functions) {
  Result<GlRenderer> renderer = GlRenderer::create(functions);
  if (!renderer) return renderer.error();
  std::unique_ptr<GpuPictures> pictures(new GpuPictures(functions, std::move(*renderer)));
  functions.GenTextures(1, &pictures->texture_);
  functions.GenFramebuffers(1, &pictures->framebuffer_);
  return pictures;
}

GpuPictures::~GpuPictures() {
  if (abandoned_) return;
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

void GpuPictures::abandon() {
  abandoned_ = true;
  renderer_.abandon();
}

Status GpuPictures::begin(const Scene& scene, bool new_lights, const RenderSettings& settings) {
  if (new_lights)
    if (Status status = renderer_.set_lights(scene); !status) return status;
  settings_ = settings;
  transfer_ = scene.picture.transfer;
  return renderer_.begin(scene.camera, settings);
}

Status GpuPictures::keep() {
  if (settings_.width_px != width_ || settings_.height_px != height_) {
    width_ = height_ = 0;
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, texture_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, settings_.width_px, settings_.height_px, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    const bool complete = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!complete) return Error{"the graphics processor has no room for so large a picture", "", 0, 0, ""};
    width_ = settings_.width_px;
    height_ = settings_.height_px;
  }
  renderer_.show(framebuffer_, {0, 0, width_, height_}, transfer_);
  return Done{};
}

void GpuPictures::show(std::uint32_t framebuffer, const GlViewport& viewport) const {
  if (width_ == 0) return;
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl_.BlitFramebuffer(0, 0, width_, height_, viewport.x, viewport.y, viewport.x + viewport.width,
                      viewport.y + viewport.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace bihive
