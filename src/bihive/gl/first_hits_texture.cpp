#include "bihive/gl/first_hits_texture.h"

#include <array>

#include "bihive/gl/film_textures.h"

namespace bihive {

Status FirstHitsTexture::resize(int width_px, int height_px) {
  if (width_px == width_ && height_px == height_) return Done{};
  destroy();
  gl_->ActiveTexture(GL_TEXTURE0);
  texture_ = make_texture(*gl_);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, width_px, height_px, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
  gl_->BindTexture(GL_TEXTURE_2D, 0);
  gl_->GenFramebuffers(1, &framebuffer_);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  const bool complete = gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
  width_ = width_px;
  height_ = height_px;
  if (complete && gl_->GetError() == GL_NO_ERROR) return Done{};
  destroy();
  return Error{"the graphics processor has no room for the outlines of so large a picture", "", 0, 0,
               "draw a smaller one"};
}

void FirstHitsTexture::destroy() {
  if (texture_ == 0) return;
  gl_->DeleteFramebuffers(1, &framebuffer_);
  gl_->DeleteTextures(1, &texture_);
  texture_ = framebuffer_ = 0;
  width_ = height_ = 0;
}

void FirstHitsTexture::draw_into() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_->Viewport(0, 0, width_, height_);
}

void FirstHitsTexture::wait() const {
  std::array<GLuint, 4> pixel{};
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_->ReadPixels(0, 0, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, pixel.data());
}

}  // namespace bihive
