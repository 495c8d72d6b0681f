#include "shown_frames_window.h"

#include <GLFW/glfw3.h>

#include <chrono>

#include "../shared/processor_name.h"
#include "bihive/simd/target.h"
#include "bihive/thesis/shown_frames.h"
#include "picture_texture.h"
#include "window.h"

namespace bihive::window {
namespace {

double clock_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// The window's driver: a software one takes time from the frames.
std::string device_words(const Gl& gl) {
  const auto* const renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  return processor_name() + ", vectors: " + std::string(active_target()) + "; the window by " +
         (renderer == nullptr ? "an unknown OpenGL" : renderer);
}

}  // namespace

Result<std::string> measure_shown_frames(double seconds) {
  const Result<StatedValues> values = StatedValues::parse(builtin_values_figure_4_4(), "thesis/figure-4.4/values.json");
  if (!values) return values.error();
  Result<ShownFramesPlan> plan = ShownFramesPlan::from_values(*values);
  if (!plan) return plan.error();
  plan->seconds = seconds;
  ShownFrames frames(std::move(*plan));

  const int width = frames.plan().width_px, height = frames.plan().height_px;
  Result<std::unique_ptr<Window>> opened =
      Window::open("bihive: frames shown per second", width, height, nullptr, [](GLFWwindow*) {});
  if (!opened) return opened.error();
  Window& window = **opened;
  PictureTexture texture(window.gl());
  const auto unit = static_cast<float>(1 / window.pixels_per_unit());
  while (!frames.finished()) {
    glfwPollEvents();
    if (glfwWindowShouldClose(window.handle()) != GLFW_FALSE)
      return Error{"the window was closed before all frames were shown", "", 0, 0, ""};
    const Result<const Image*> image = frames.draw();
    if (!image) return image.error();
    texture.take(**image);
    const PixelSize pixels = window.framebuffer();
    window.gl().Viewport(0, 0, pixels.width, pixels.height);
    window.begin_frame();
    texture.draw({static_cast<float>(width) * unit, static_cast<float>(height) * unit});
    window.end_frame();
    // Without this the next picture would begin while this one waits in a queue.
    window.gl().Finish();
    frames.shown(clock_ms());
  }
  return frames.json("window", device_words(window.gl()));
}

}  // namespace bihive::window
