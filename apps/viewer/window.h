// A window of the screen with a context of OpenGL and Dear ImGui in it.
#pragma once

#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/image/image.h"
#include "gl.h"

struct GLFWwindow;

namespace bihive::window {

struct PixelSize {
  int width, height;
};

class Window {
 public:
  /// Width and height in the screen's units. Error: no screen, or no OpenGL 3.3; the message says which. `listener`
  /// becomes the window's user pointer before ImGui adds its own callbacks after those that `listen` sets.
  static Result<std::unique_ptr<Window>> open(const std::string& title, int width, int height, void* listener,
                                              void (*listen)(GLFWwindow*));
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  const Gl& gl() const { return gl_; }
  PixelSize framebuffer() const;
  /// Pixels of the framebuffer for one unit of the pointer's and ImGui's coordinates.
  double pixels_per_unit() const;
  /// The size of text and controls relative to a plain screen, in those units.
  double text_scale() const { return text_scale_; }

  void begin_frame();
  /// Draws the commands that ImGui collected, and shows everything. With `picture` the framebuffer is copied there
  /// first.
  void end_frame(Image* picture = nullptr);

 private:
  explicit Window(GLFWwindow* window) : window_(window) {}
  void start_imgui();

  GLFWwindow* window_;
  Gl gl_;
  double text_scale_ = 1;
};

}  // namespace bihive::window
