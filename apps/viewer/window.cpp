#include "window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "theme.h"

namespace bihive::window {
namespace {

Error no_window(const std::string& what, const std::string& hint) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  const std::string why = reason == nullptr ? "" : std::string(" (") + reason + ")";
  return {what + why, "", 0, 0, hint};
}

}  // namespace

Result<Gl> load_gl() {
  Gl gl;
  const char* missing = nullptr;
  // NOLINTBEGIN(bugprone-macro-parentheses): they are parts of a type
#define BIHIVE_WINDOW_GL_LOAD(type, name, parameters)                                        \
  gl.name = reinterpret_cast<type(GL_APIENTRY*) parameters>(glfwGetProcAddress("gl" #name)); \
  if (gl.name == nullptr) missing = "gl" #name;
  BIHIVE_WINDOW_GL_FUNCTIONS(BIHIVE_WINDOW_GL_LOAD)
#undef BIHIVE_WINDOW_GL_LOAD
  // NOLINTEND(bugprone-macro-parentheses)
  if (missing != nullptr) return Error{std::string("OpenGL here has no ") + missing, "", 0, 0, ""};
  return gl;
}

Result<std::unique_ptr<Window>> Window::open(const std::string& title, int width, int height, void* listener,
                                             void (*listen)(GLFWwindow*)) {
  if (glfwInit() == GLFW_FALSE)
    return no_window("no window can be opened here", "set DISPLAY, or draw a picture with bihive render");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GLFWwindow* const handle = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (handle == nullptr) {
    Error error = no_window("OpenGL 3.3 is not to be had here", "on Debian: apt-get install libgl1-mesa-dri");
    glfwTerminate();
    return error;
  }
  std::unique_ptr<Window> window(new Window(handle));
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(1);
  Result<Gl> gl = load_gl();
  window->start_imgui();
  if (!gl) return gl.error();
  window->gl_ = *gl;
  glfwSetWindowUserPointer(handle, listener);
  listen(handle);
  ImGui_ImplGlfw_InitForOpenGL(handle, /*install_callbacks=*/true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  return window;
}

void Window::start_imgui() {
  // If the pointer's units are pixels, text is larger; else the units themselves are larger.
  float scale_x = 1, scale_y = 1;
  glfwGetWindowContentScale(window_, &scale_x, &scale_y);
  const double scale = std::clamp<double>(std::max(scale_x, scale_y), 1, 4);
  text_scale_ = std::max(1.0, scale / pixels_per_unit());
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  use_theme(text_scale_, pixels_per_unit());
}

Window::~Window() {
  if (ImGui::GetIO().BackendRendererUserData != nullptr) ImGui_ImplOpenGL3_Shutdown();
  if (ImGui::GetIO().BackendPlatformUserData != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

PixelSize Window::framebuffer() const {
  PixelSize size{};
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

double Window::pixels_per_unit() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  const PixelSize pixels = framebuffer();
  return width > 0 && pixels.width > 0 ? static_cast<double>(pixels.width) / width : 1;
}

void Window::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::end_frame(Image* picture) {
  ImGui::Render();
  const PixelSize size = framebuffer();
  gl_.Viewport(0, 0, size.width, size.height);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (picture != nullptr) {
    // Reverse the rows: the first row is at the bottom.
    const std::size_t row = 3 * static_cast<std::size_t>(size.width);
    std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(size.height));
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    *picture = {size.width, size.height, {}};
    picture->rgb.reserve(pixels.size());
    for (auto y = static_cast<std::size_t>(size.height); y-- > 0;)
      picture->rgb.insert(picture->rgb.end(), pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                          pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
  }
  glfwSwapBuffers(window_);
}

}  // namespace bihive::window
