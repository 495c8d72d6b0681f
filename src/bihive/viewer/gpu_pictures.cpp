#include "bihive/viewer/gpu_pictures.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/image/png_pixels.h"
#include "bihive/viewer/shown_image.h"

namespace bihive {
namespace {

// OpenGL's rows count from below, and its colours are multiplied by their opacity.

PngPixels from_framebuffer(const std::vector<std::uint8_t>& rgba, int width, int height, bool with_opacity) {
  PngPixels pixels{width, height, with_opacity ? 4 : 3, 8, {}};
  pixels.bytes.reserve(pixels.row_bytes() * std::size_t(height));
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* const pixel = &rgba[std::size_t(4) * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
      const int opacity = with_opacity ? pixel[3] : 255;
      for (int channel = 0; channel < 3; ++channel)
        pixels.bytes.push_back(static_cast<std::uint8_t>(
            opacity == 0 ? 0 : std::min(255, (pixel[channel] * 255 + opacity / 2) / opacity)));
      if (with_opacity) pixels.bytes.push_back(pixel[3]);
    }
  return pixels;
}

std::vector<std::uint8_t> for_texture(const PngPixels& pixels) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(std::size_t(4) * std::size_t(pixels.width) * std::size_t(pixels.height));
  const auto channels = std::size_t(pixels.channels);
  for (int y = pixels.height - 1; y >= 0; --y)
    for (int x = 0; x < pixels.width; ++x) {
      const std::uint8_t* const pixel =
          &pixels.bytes[channels * (std::size_t(y) * std::size_t(pixels.width) + std::size_t(x))];
      const int opacity = channels == 4 ? pixel[3] : 255;
      for (int channel = 0; channel < 3; ++channel)
        rgba.push_back(static_cast<std::uint8_t>((pixel[channel] * opacity + 127) / 255));
      rgba.push_back(static_cast<std::uint8_t>(opacity));
    }
  return rgba;
}

}  // namespace

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
  renderer_.show(framebuffer_, {0, 0, width_, height_}, transfer_, checks_);
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

// The CPU draws the labels, as on its own pictures.
Status GpuPictures::put_labels(const Scene& scene, const RenderSettings& whole) {
  std::vector<std::uint8_t> rgba(std::size_t(4) * std::size_t(width_) * std::size_t(height_));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  PngPixels pixels = labelled(from_framebuffer(rgba, width_, height_, /*with_opacity=*/!checks_), scene, whole);

  if (Status status = make_room(pixels.width, pixels.height); !status) return status;
  rgba = for_texture(pixels);
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
