#include "bihive/viewer/gpu_pictures.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/viewer/shown_image.h"

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

Status GpuPictures::keep(const Scene& scene, const RenderSettings& whole) {
  if (Status status = make_room(settings_.width_px, settings_.height_px); !status) return status;
  renderer_.show(framebuffer_, {0, 0, width_, height_}, transfer_);
  return whole.labels.any() ? put_labels(scene, whole) : Done{};
}

Status GpuPictures::make_room(int width_px, int height_px) {
  if (width_px == width_ && height_px == height_) return Done{};
  width_ = height_ = 0;
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_px, height_px, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  const bool complete = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete) return Error{"the graphics processor has no room for so large a picture", "", 0, 0, ""};
  width_ = width_px;
  height_ = height_px;
  return Done{};
}

// The CPU draws the labels, as on its own pictures. OpenGL's rows count from below.
Status GpuPictures::put_labels(const Scene& scene, const RenderSettings& whole) {
  std::vector<std::uint8_t> rgba(std::size_t(4) * std::size_t(width_) * std::size_t(height_));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  Image image{width_, height_, {}};
  image.rgb.reserve(rgba.size() / 4 * 3);
  for (int y = height_ - 1; y >= 0; --y)
    for (int x = 0; x < width_; ++x) {
      const std::uint8_t* const pixel = &rgba[std::size_t(4) * (std::size_t(y) * std::size_t(width_) + std::size_t(x))];
      image.rgb.insert(image.rgb.end(), pixel, pixel + 3);
    }
  image = labelled(std::move(image), scene, whole);

  if (Status status = make_room(image.width, image.height); !status) return status;
  rgba.clear();
  for (int y = height_ - 1; y >= 0; --y)
    for (int x = 0; x < width_; ++x) {
      const std::uint8_t* const pixel =
          &image.rgb[std::size_t(3) * (std::size_t(y) * std::size_t(width_) + std::size_t(x))];
      rgba.insert(rgba.end(), {pixel[0], pixel[1], pixel[2], 255});
    }
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  gl_.BindTexture(GL_TEXTURE_2D, 0);
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
