#include "bihive/gl/film_textures.h"

#include <cstring>

namespace bihive {

GLuint make_texture(const GlFunctions& gl) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

bool FilmTextures::make(GLint format, int width_px, int height_px) {
  destroy();
  const bool bits = format == GL_RGBA32UI;
  bool complete = true;
  for (std::size_t i = 0; i < 2; ++i) {
    textures_[i] = make_texture(*gl_);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, format, width_px, height_px, 0, bits ? GL_RGBA_INTEGER : GL_RGBA,
                    bits ? GL_UNSIGNED_INT : GL_FLOAT, nullptr);
    gl_->GenFramebuffers(1, &framebuffers_[i]);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[i]);
    gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures_[i], 0);
    complete = complete && gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
  width_ = width_px;
  height_ = height_px;
  return gl_->GetError() == GL_NO_ERROR && complete;
}

Status FilmTextures::choose_format() {
  bool found = false;
  for (const GLint format : {GL_RGBA32F, GL_RGBA32UI}) {
    format_ = format;
    if ((found = make(format, 4, 4))) break;
  }
  destroy();
  if (found) return Done{};
  return Error{"this graphics processor cannot draw into textures of 128 bits per texel", "", 0, 0,
               "choose an engine of the CPU"};
}

Status FilmTextures::resize(int width_px, int height_px) {
  if (width_px == width_ && height_px == height_) return Done{};
  if (make(format_, width_px, height_px)) return Done{};
  destroy();
  return Error{"the graphics processor has no room for a picture of " + std::to_string(width_px) + " x " +
                   std::to_string(height_px) + " pixels",
               "", 0, 0, "draw a smaller one"};
}

void FilmTextures::destroy() {
  if (width_ == 0) return;
  gl_->DeleteFramebuffers(2, framebuffers_.data());
  gl_->DeleteTextures(2, textures_.data());
  framebuffers_ = textures_ = {};
  width_ = height_ = 0;
}

void FilmTextures::draw_into(int index) const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[static_cast<std::size_t>(index)]);
  gl_->Viewport(0, 0, width_, height_);
}

void FilmTextures::fill(int index, Vec3f colour) const {
  draw_into(index);
  gl_->Disable(GL_SCISSOR_TEST);
  if (of_bits()) {
    const std::array<float, 4> texel{colour.x, colour.y, colour.z, 0};
    std::array<GLuint, 4> bits{};
    std::memcpy(bits.data(), texel.data(), sizeof(bits));
    gl_->ClearBufferuiv(GL_COLOR, 0, bits.data());
  } else {
    gl_->ClearColor(colour.x, colour.y, colour.z, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
  }
}

void FilmTextures::read(int index, int y0, int y1, std::vector<float>& rgba) const {
  rgba.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(y1 - y0));
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[static_cast<std::size_t>(index)]);
  read_pixels(y0, width_, y1 - y0, rgba.data());
}

void FilmTextures::wait(int index) const {
  std::array<float, 4> pixel{};
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[static_cast<std::size_t>(index)]);
  read_pixels(0, 1, 1, pixel.data());
}

void FilmTextures::read_pixels(int y0, int width, int height, float* rgba) const {
  gl_->ReadPixels(0, y0, width, height, of_bits() ? GL_RGBA_INTEGER : GL_RGBA, of_bits() ? GL_UNSIGNED_INT : GL_FLOAT,
                  rgba);
}

}  // namespace bihive
