// A picture of the CPU as a texture drawn by ImGui.
#pragma once

#include <imgui.h>

#include "bihive/image/image.h"
#include "gl.h"

namespace bihive::window {

/// Its context must be current in every call, also in the destructor.
class PictureTexture {
 public:
  explicit PictureTexture(const Gl& gl) : gl_(gl) {}
  ~PictureTexture() {
    if (texture_ != 0) gl_.DeleteTextures(1, &texture_);
  }
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;

  void take(const Image& image) {
    if (texture_ == 0) gl_.GenTextures(1, &texture_);
    gl_.BindTexture(GL_TEXTURE_2D, texture_);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    filled_ = true;
  }
  void forget() { filled_ = false; }

  /// Draws behind everything, in ImGui's units.
  void draw(ImVec2 size) const {
    if (!filled_) return;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's backend keeps names of textures so
    const auto name = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture_));
    ImGui::GetBackgroundDrawList()->AddImage(name, {0, 0}, size);
  }

 private:
  const Gl& gl_;
  GLuint texture_ = 0;
  bool filled_ = false;
};

}  // namespace bihive::window
