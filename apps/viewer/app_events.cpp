// Keys, pointer and dropped files.

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app.h"
#include "bihive/scene/names.h"

namespace bihive::window {
namespace {

constexpr double kZoomOfNotch = 1.15;
constexpr double kTurnOfKeyPx = 24;  // the turn or shift of an arrow key
constexpr double kMostClick = 4;     // the pointer's way during a click, in its units
constexpr double kDoubleClickMs = 350;
constexpr double kCloser = 0.5;  // a double click leaves this share of the distance

App& app_of(GLFWwindow* window) {
  return *static_cast<App*>(glfwGetWindowUserPointer(window));
}

std::string utf8_of(unsigned character) {
  std::string text;
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  if (character < 0x80) return put(character), text;
  if (character < 0x800) {
    put(0xC0 | character >> 6);
  } else if (character < 0x10000) {
    put(0xE0 | character >> 12);
    put(0x80 | (character >> 6 & 0x3F));
  } else {
    put(0xF0 | character >> 18);
    put(0x80 | (character >> 12 & 0x3F));
    put(0x80 | (character >> 6 & 0x3F));
  }
  put(0x80 | (character & 0x3F));
  return text;
}

}  // namespace

void App::listen(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
    app_of(w).wake();
    app_of(w).act();
    app_of(w).on_key(key, action, mods);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    app_of(w).wake();
    app_of(w).act();
    app_of(w).on_button(button, action, mods);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    app_of(w).wake();
    for (const int button : {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE})
      if (glfwGetMouseButton(w, button) == GLFW_PRESS) app_of(w).act();
    app_of(w).on_cursor(x, y);
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) {
    app_of(w).wake();
    app_of(w).act();
    app_of(w).on_wheel(dy);
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
    app_of(w).wake();
    app_of(w).act();
    app_of(w).on_character(character);
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { app_of(w).wake(); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { app_of(w).wake(); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { app_of(w).wake(); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    app_of(w).wake();
    app_of(w).on_drop({paths, paths + count});
  });
}

// While the card "Open" is there, letters are those of a path.
bool App::types_path() const {
  return cards_.open() == "open" && controls_shown_ && !ImGui::GetIO().WantTextInput;
}

void App::on_key(int key, int action, int mods) {
  turn();
  if (action == GLFW_RELEASE) return;
  welcomes_ = false;
  if (key == GLFW_KEY_F1) {
    help_shown_ = !help_shown_;
    return;
  }
  if (ImGui::GetIO().WantTextInput) return;
  if (key == GLFW_KEY_ESCAPE) return on_escape();
  if (types_path()) return on_path_key(key, mods);
  const bool again = action == GLFW_REPEAT;
  const double step = kTurnOfKeyPx * window_->pixels_per_unit() * window_->text_scale();
  const auto turn = [&](double dx, double dy) {
    framed_ = false;
    if ((mods & GLFW_MOD_SHIFT) != 0)
      viewer_.pan(dx * step, dy * step);
    else
      viewer_.orbit(dx * step, dy * step);
  };
  switch (key) {
    case GLFW_KEY_LEFT:
      return turn(-1, 0);
    case GLFW_KEY_RIGHT:
      return turn(1, 0);
    case GLFW_KEY_UP:
      return turn(0, -1);
    case GLFW_KEY_DOWN:
      return turn(0, 1);
    case GLFW_KEY_EQUAL:  // with or without shift, "+" on most keyboards
    case GLFW_KEY_KP_ADD:
      return zoom(kZoomOfNotch);
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      return zoom(1 / kZoomOfNotch);
    default:
      break;
  }
  // Letters by the layout of the user's keyboard.
  const char* const name = glfwGetKeyName(key, 0);
  const char letter = key == GLFW_KEY_HOME ? 'r' : name == nullptr ? '\0' : name[0];
  if ((mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0) {
    if (letter == 'z') undo((mods & GLFW_MOD_SHIFT) != 0 ? 1 : -1);
    if (letter == 'y') undo(1);
    return;
  }
  if (letter == ',') return step_frames(-1);
  if (letter == '.') return step_frames(1);
  if (again) return;
  if (key == GLFW_KEY_SPACE) return toggle_play();
  if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) {
    const ImVec2 size = picture_size();
    return pin(size.x / 2.0, size.y / 2.0);
  }
  if (key >= GLFW_KEY_1 && key < GLFW_KEY_1 + static_cast<int>(kViews.size())) {
    ViewerSettings settings = viewer_.settings();
    settings.view = kViews[static_cast<std::size_t>(key - GLFW_KEY_1)].second;
    return apply(settings);
  }
  on_letter(letter);
}

void App::on_letter(char letter) {
  ViewerSettings settings = viewer_.settings();
  switch (letter) {
    case '+':
      return zoom(kZoomOfNotch);
    case 'c':
      return copy_command(CommandOf::picture);
    case 'e':
      settings.engine = settings.engine == ViewerEngine::cpu ? ViewerEngine::gpu : ViewerEngine::cpu;
      return apply(settings);
    case 'h':
      controls_shown_ = !controls_shown_;
      return;
    case 'o':
      controls_shown_ = true;
      path_is_new_ = true;
      return open_card("open");
    case 'q':
      return glfwSetWindowShouldClose(window_->handle(), GLFW_TRUE);
    case 'r':
      return home();
    case 's':
      return begin_save();
    default:
      return;
  }
}

// The help, a card, long work, a message, pins: the first of these that is there goes.
void App::on_escape() {
  if (help_shown_)
    help_shown_ = false;
  else if (!cards_.open().empty() && controls_shown_)
    cards_.close();
  else if (save_ || search_)
    end_work();
  else if (!message_.empty())
    message_.clear();
  else
    cards_.pins.clear();
}

void App::on_path_key(int key, int mods) {
  path_is_new_ = false;
  const bool with_control = (mods & GLFW_MOD_CONTROL) != 0;
  if (key == GLFW_KEY_BACKSPACE) return cards_.file.erase();
  if (key == GLFW_KEY_TAB) return cards_.file.complete();
  if (key == GLFW_KEY_UP || key == GLFW_KEY_DOWN) return cards_.file.move(key == GLFW_KEY_UP ? -1 : 1);
  if (key == GLFW_KEY_V && with_control) {
    if (const char* pasted = glfwGetClipboardString(window_->handle())) cards_.file.type(pasted);
    return;
  }
  if (key != GLFW_KEY_ENTER && key != GLFW_KEY_KP_ENTER) return;
  file_to_open_ = cards_.file.take();
  if (file_to_open_) cards_.close();
}

void App::on_character(unsigned character) {
  if (std::exchange(path_is_new_, false)) return;
  if (types_path()) return cards_.file.type(utf8_of(character));
  if (character == '?' && !ImGui::GetIO().WantTextInput) help_shown_ = !help_shown_;
}

// The pointer's position at this event: ImGui has that of the last frame only, and GLFW the current one. So the
// position is compared with the areas of the controls, instead of asking ImGui.
bool App::over_picture() const {
  const ImVec2 size = picture_size();
  const double scale = window_->pixels_per_unit();
  return !popup_open_ && x_ * scale < size.x && y_ * scale < size.y && !covered_.has(x_, y_);
}

void App::on_button(int button, int action, int mods) {
  turn();
  welcomes_ = welcomes_ && !over_picture();
  if (action == GLFW_RELEASE) {
    if (may_be_click_ && drag_ == Drag::orbit) on_click();
    drag_ = Drag::none;
    may_be_click_ = false;
    return;
  }
  if (!over_picture()) return;
  const bool shifts = button != GLFW_MOUSE_BUTTON_LEFT || (mods & GLFW_MOD_SHIFT) != 0;
  drag_ = shifts ? Drag::pan : Drag::orbit;
  may_be_click_ = true;
  down_x_ = x_;
  down_y_ = y_;
}

// A click closes the card, or pins a sphere; twice is to come closer.
void App::on_click() {
  const double scale = window_->pixels_per_unit(), now = 1000 * glfwGetTime();
  const bool is_second = now - std::exchange(last_click_ms_, now) < kDoubleClickMs;
  if (help_shown_) {
    help_shown_ = false;
    return;
  }
  if (controls_shown_ && cards_.dismiss(layout())) return;
  // The second click of two takes the pin of the first one away.
  pin(x_ * scale, y_ * scale);
  if (is_second) approach(x_ * scale, y_ * scale);
}

void App::pin(double x_px, double y_px) {
  if (std::optional<NamedSphere> sphere = Pins::named(viewer_, x_px, y_px))
    cards_.pins.toggle(viewer_, std::move(*sphere));
}

// The camera turns to the sphere there, and comes closer.
void App::approach(double x_px, double y_px) {
  const std::optional<NamedSphere> sphere = Pins::named(viewer_, x_px, y_px);
  if (!sphere) return;
  ViewerSettings settings = viewer_.settings();
  Camera& camera = settings.camera;
  camera.eye = sphere->centre + kCloser * (camera.eye - camera.look_at);
  camera.look_at = sphere->centre;
  if (camera.projection == Projection::orthographic) camera.shorter_side *= kCloser;
  framed_ = false;
  apply(settings);
}

void App::on_cursor(double x, double y) {
  const double scale = window_->pixels_per_unit();
  const double dx = scale * (x - x_), dy = scale * (y - y_);
  x_ = x;
  y_ = y;
  if (dx == 0 && dy == 0) return;
  tip_.reset();
  rests_since_ms_.reset();
  if (drag_ == Drag::none && over_picture() && request_.screenshot.empty()) rests_since_ms_ = 1000 * glfwGetTime();
  if (std::hypot(x - down_x_, y - down_y_) > kMostClick) may_be_click_ = false;
  if (drag_ != Drag::none) framed_ = false;
  if (drag_ == Drag::orbit) turned_x_ += dx, turned_y_ += dy;
  if (drag_ == Drag::pan) viewer_.pan(dx, dy);
}

// A turn takes a pass over the spheres while all of them stay in view, and a pointer may move many times a frame.
void App::turn() {
  const double dx = std::exchange(turned_x_, 0), dy = std::exchange(turned_y_, 0);
  if (dx != 0 || dy != 0) viewer_.orbit(dx, dy);
}

void App::on_wheel(double dy) {
  tip_.reset();
  turn();
  if (!over_picture()) return;
  const double scale = window_->pixels_per_unit();
  framed_ = false;
  welcomes_ = false;
  viewer_.zoom(std::pow(kZoomOfNotch, std::clamp(dy, -10.0, 10.0)), x_ * scale, y_ * scale);
}

void App::on_drop(std::vector<std::string> paths) {
  welcomes_ = false;
  dropped_several_ = paths.size() > 1;
  if (!paths.empty()) file_to_open_ = std::move(paths.front());
}

}  // namespace bihive::window
