#include "app.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/image/png.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/names.h"
#include "bihive/viewer/load_file.h"
#include "bihive/viewer/viewer_json.h"
#include "theme.h"

namespace bihive::window {
namespace {

constexpr double kBudgetMs = 16;
constexpr double kIdleSeconds = 0.5;
constexpr double kShortestWait = 1e-4;
constexpr double kZoomOfNotch = 1.15;
constexpr double kTurnOfKeyPx = 24;  // the turn or shift of an arrow key

App& app_of(GLFWwindow* window) {
  return *static_cast<App*>(glfwGetWindowUserPointer(window));
}

double now_ms() {
  return 1000 * glfwGetTime();
}

// "demo.png", or "demo-2.png" if that exists.
std::string free_name(const std::string& wanted) {
  const std::filesystem::path path(wanted);
  std::error_code ignored;
  std::string name = wanted;
  for (int number = 2; std::filesystem::exists(name, ignored); ++number)
    name = (path.parent_path() / (path.stem().string() + "-" + std::to_string(number) + path.extension().string()))
               .string();
  return name;
}

}  // namespace

App::~App() {
  viewer_.detach_gl(false);
  texture_.reset();
}

Status App::open() {
  Result<std::unique_ptr<Window>> window = Window::open("bihive", request_.width, request_.height, this, &App::listen);
  if (!window) return window.error();
  window_ = std::move(*window);
  texture_ = std::make_unique<PictureTexture>(window_->gl());

  // A missing GPU is an error only if the user chose it.
  const Result<GlFunctions> functions = load_gl_functions(glfwGetProcAddress);
  const Status attached = functions ? viewer_.attach_gl(*functions) : Status(functions.error());
  const ImVec2 size = picture_size();
  viewer_.resize(static_cast<int>(size.x), static_cast<int>(size.y));
  const Result<ViewerSettings> asked = settings_from_json(request_.settings, viewer_.settings());
  if (!asked) return asked.error();
  if (asked->engine == ViewerEngine::gpu && !attached) return attached.error();
  ViewerSettings settings = viewer_.settings();
  settings.engine = asked->engine;
  if (Status status = viewer_.set(settings); !status) return status;
  panel_.reading = request_.reading;
  opened(viewer_.facts());
  take_frames(std::move(first_frames_), request_.reading.frame);
  return Done{};
}

void App::listen(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
    app_of(w).wake();
    app_of(w).on_key(key, action, mods);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    app_of(w).wake();
    app_of(w).on_button(button, action, mods);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    app_of(w).wake();
    app_of(w).on_cursor(x, y);
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) {
    app_of(w).wake();
    app_of(w).on_wheel(dy);
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
    app_of(w).wake();
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

// --- Events of the window --------------------------------------------------------------------------------------

// Longer than most functions: a switch with a line or two per key.
void App::on_key(int key, int action, int mods) {
  if (action == GLFW_RELEASE) return;
  if (asked_file_) return on_prompt_key(key, mods);
  if (ImGui::GetIO().WantTextInput) return;
  const bool again = action == GLFW_REPEAT;
  const double step = kTurnOfKeyPx * window_->pixels_per_unit() * window_->text_scale();
  const auto turn = [&](double dx, double dy) {
    framed_ = false;
    if ((mods & GLFW_MOD_SHIFT) != 0)
      viewer_.pan(dx * step, dy * step);
    else
      viewer_.orbit(dx * step, dy * step);
  };
  const auto zoom = [&](double factor) {
    const ImVec2 size = picture_size();
    framed_ = false;
    viewer_.zoom(factor, size.x / 2.0, size.y / 2.0);
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
  if (letter == ',') return step_frames(-1);
  if (letter == '.') return step_frames(1);
  if (again) return;
  if (key == GLFW_KEY_SPACE) return toggle_play();
  ViewerSettings settings = viewer_.settings();
  if (key >= GLFW_KEY_1 && key < GLFW_KEY_1 + static_cast<int>(kViews.size())) {
    settings.view = kViews[static_cast<std::size_t>(key - GLFW_KEY_1)].second;
    return apply(settings);
  }
  switch (letter) {
    case '+':
      return zoom(kZoomOfNotch);
    case 'e':
      settings.engine = settings.engine == ViewerEngine::cpu ? ViewerEngine::gpu : ViewerEngine::cpu;
      return apply(settings);
    case 'h':
      panel_shown_ = !panel_shown_;
      return;
    case 'o':
      asked_file_ = "";
      prompt_is_new_ = true;
      return;
    case 'q':
      glfwSetWindowShouldClose(window_->handle(), GLFW_TRUE);
      return;
    case 'r':
      framed_ = true;
      return viewer_.home();
    case 's':
      return save();
    default:
      if (key == GLFW_KEY_ESCAPE) message_.clear();
  }
}

// The name of a file is typed event by event, not frame by frame, so that no letter is lost while a picture is drawn.
void App::on_prompt_key(int key, int mods) {
  prompt_is_new_ = false;
  if (key == GLFW_KEY_BACKSPACE) {
    // A UTF-8 character begins at the last byte that is not a continuation.
    while (!asked_file_->empty() && (static_cast<unsigned char>(asked_file_->back()) & 0xC0) == 0x80)
      asked_file_->pop_back();
    if (!asked_file_->empty()) asked_file_->pop_back();
  } else if (key == GLFW_KEY_V && (mods & GLFW_MOD_CONTROL) != 0) {
    if (const char* pasted = glfwGetClipboardString(window_->handle())) *asked_file_ += pasted;
  } else if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) {
    if (!asked_file_->empty()) file_to_open_ = *asked_file_;
    asked_file_.reset();
  } else if (key == GLFW_KEY_ESCAPE) {
    asked_file_.reset();
  }
}

void App::on_character(unsigned character) {
  // The letter of the key that opened the prompt comes after this event.
  if (!asked_file_ || std::exchange(prompt_is_new_, false)) return;
  const auto put = [&](unsigned byte) { *asked_file_ += static_cast<char>(byte); };
  if (character < 0x80) return put(character);
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
}

// The pointer's position at this event: ImGui has that of the last frame only, and GLFW the current one. So the
// position is compared with the overlay's rectangle, instead of asking ImGui.
bool App::over_picture() const {
  const bool over_message = (asked_file_ || !message_.empty()) && x_ >= overlay_min_.x && x_ < overlay_max_.x &&
                            y_ >= overlay_min_.y && y_ < overlay_max_.y;
  const float bar = reader_ ? player_bar_height(window_->text_scale()) : 0;
  const bool over_bar = y_ >= ImGui::GetIO().DisplaySize.y - bar;
  return x_ * window_->pixels_per_unit() < picture_size().x && !over_bar && !over_message;
}

void App::on_button(int button, int action, int mods) {
  if (action == GLFW_RELEASE) {
    drag_ = Drag::none;
    return;
  }
  if (!over_picture()) return;
  const bool shifts = button != GLFW_MOUSE_BUTTON_LEFT || (mods & GLFW_MOD_SHIFT) != 0;
  drag_ = shifts ? Drag::pan : Drag::orbit;
}

void App::on_cursor(double x, double y) {
  const double scale = window_->pixels_per_unit();
  const double dx = scale * (x - x_), dy = scale * (y - y_);
  x_ = x;
  y_ = y;
  if (dx == 0 && dy == 0) return;
  if (drag_ != Drag::none) framed_ = false;
  if (drag_ == Drag::orbit) viewer_.orbit(dx, dy);
  if (drag_ == Drag::pan) viewer_.pan(dx, dy);
}

void App::on_wheel(double dy) {
  if (!over_picture()) return;
  const double scale = window_->pixels_per_unit();
  framed_ = false;
  viewer_.zoom(std::pow(kZoomOfNotch, std::clamp(dy, -10.0, 10.0)), x_ * scale, y_ * scale);
}

void App::on_drop(std::vector<std::string> paths) {
  dropped_several_ = paths.size() > 1;
  if (!paths.empty()) file_to_open_ = std::move(paths.front());
}

// --- Actions on events ------------------------------------------------------------------------------------------

void App::open_file(const std::string& path) {
  Result<LoadedFile> file = load_file(viewer_, path, {});
  if (!file) return say(file.error().to_string(), true);
  input_ = path;
  panel_.reading = {};
  opened(file->facts);
  take_frames(std::move(file->frames), 0);
}

void App::open_built_in(const std::string& name) {
  const Result<SceneFacts> facts = viewer_.load_built_in(name);
  if (facts) input_ = name;
  if (facts) panel_.reading = {};
  if (facts) request_.scenario = {};
  opened(facts);
  if (facts) take_frames(nullptr, 0);
}

// The same input with other radii, with the same appearance and settings. A camera that was not moved is placed again.
void App::read_again(const ReadOptions& wanted) {
  ReadOptions reading = wanted;
  reading.frame = reader_ ? frame_in_viewer_ : reading.frame;
  const ViewerLook look = viewer_.look();
  ViewerSettings settings = viewer_.settings();
  ScenarioParameters scenario = request_.scenario;
  scenario.radius = reading.radius ? scenario_radius(*reading.radius) : ScenarioParameters{}.radius;
  std::shared_ptr<const Frames> frames;
  if (is_built_in_scene(input_)) {
    const Result<SceneFacts> loaded = viewer_.load_built_in(input_, scenario, reading);
    if (!loaded) return say(loaded.error().to_string(), true);
  } else {
    Result<LoadedFile> loaded = load_file(viewer_, input_, reading);
    if (!loaded) return say(loaded.error().to_string(), true);
    frames = std::move(loaded->frames);
  }
  panel_.reading = reading;
  const std::string file_name = panel_.file_name;
  const bool framed = framed_;
  std::string words;
  if (const auto shown = viewer_.set_look(look); !shown) words = shown.error().to_string();
  if (framed) {
    const Camera lens = settings.camera;
    settings.camera = viewer_.settings().camera;
    settings.camera.fov_deg = lens.fov_deg;
    settings.camera.aperture = 0;
    settings.camera = with_projection(settings.camera, lens.projection);
    settings.camera.aperture = lens.aperture;
    settings.camera.focus = lens.focus;
  }
  if (Status status = viewer_.set(settings); !status) words = status.error().to_string();
  opened(viewer_.facts());
  take_frames(std::move(frames), reading.frame);
  panel_.file_name = file_name;
  framed_ = framed;
  if (!words.empty()) say(words, true);
}

void App::opened(const Result<SceneFacts>& facts) {
  if (!facts) return say(facts.error().to_string(), true);
  message_.clear();
  texture_->forget();
  panel_.table.forget();
  panel_.look.start_anew(viewer_.look());
  panel_.effects.start_anew();
  panel_.can_scale_radii = input_ == "demo" || !is_built_in_scene(input_);
  framed_ = true;
  const std::filesystem::path name(facts->name);
  panel_.file_name = name.stem().string() + ".png";
  glfwSetWindowTitle(window_->handle(), (title_of(*facts) + " - bihive").c_str());
}

void App::apply(const ViewerSettings& settings) {
  if (Status status = viewer_.set(settings); !status) return say(status.error().to_string(), true);
  if (message_is_bad_) message_.clear();
}

void App::apply(const ViewerLook& look) {
  std::size_t failed_row = 0;
  const Result<std::vector<std::int64_t>> counts = viewer_.set_look(look, &failed_row);
  if (const std::string words = panel_.look.answered(counts, failed_row); !words.empty()) return say(words, true);
  if (!counts) return;
  if (message_is_bad_) message_.clear();
  panel_.table.forget();
}

void App::follow(const PanelRequests& requests) {
  if (requests.look) apply(*requests.look);
  if (requests.settings) apply(*requests.settings);
  if (requests.side) viewer_.look_from(*requests.side);
  if (requests.home) viewer_.home();
  framed_ = framed_ || requests.side || requests.home;
  if (requests.reading) read_again(*requests.reading);
  if (requests.built_in) open_built_in(*requests.built_in);
  if (requests.save) save();
}

Result<PngPixels> App::picture_to_save() {
  const ImVec2 shown = picture_size();
  const PictureSizePx wanted = panel_.save_size;
  const int width = wanted.width > 0 ? wanted.width : static_cast<int>(shown.x);
  const int height = wanted.height > 0 ? wanted.height : static_cast<int>(shown.y);
  return viewer_.picture(width, height, samples_at_rest(viewer_.settings()));
}

void App::save() {
  const Result<PngPixels> picture = picture_to_save();
  if (!picture) return say(picture.error().to_string(), true);
  const std::string path = free_name(panel_.file_name);
  PngText text{{"Software", "bihive " + std::string(version())},
               {"Scene", viewer_.facts().name},
               {"Settings", settings_to_json(viewer_.settings())},
               {"Look", viewer_look_to_json(viewer_.look())}};
  if (reader_) text.emplace_back("Frame", std::to_string(frame_in_viewer_));
  const Result<std::string> png = encode_png(*picture, text);
  if (!png) return say(png.error().to_string(), true);
  if (Status status = write_file(path, *png); !status) return say(status.error().to_string(), true);
  std::error_code ignored;
  say(fmt::format("saved {} ({} x {})", std::filesystem::absolute(path, ignored).string(), picture->width,
                  picture->height),
      false);
}

void App::say(const std::string& text, bool bad) {
  message_ = text;
  message_is_bad_ = bad;
  wake();
}

// --- The player -------------------------------------------------------------------------------------------------

void App::take_frames(std::shared_ptr<const Frames> frames, std::int64_t frame) {
  reader_.reset();
  const std::int64_t count = frames ? frames->count() : 1;
  frame_in_viewer_ = numbered_frame(frame, count);
  frame_is_drawn_ = true;
  player_.start_anew(count, frames ? frame_in_viewer_ : 0);
  if (frames) reader_ = std::make_unique<FrameReader>(std::move(frames), [] { glfwPostEmptyEvent(); });
}

void App::toggle_play() {
  if (player_.playing())
    player_.pause();
  else
    player_.play(now_ms());
  wake();
}

void App::step_frames(int by) {
  player_.step(by);
  wake();
}

void App::go_to(std::int64_t frame) {
  player_.go_to(frame);
  wake();
}

void App::follow(const PlayerRequests& requests) {
  if (requests.toggles) toggle_play();
  if (requests.step != 0) step_frames(requests.step);
  if (requests.frame) go_to(*requests.frame);
  if (requests.frames_per_second) player_.set_frames_per_second(*requests.frames_per_second);
  if (requests.loops) player_.set_loops(*requests.loops);
}

// Shows the requested frame once the reader has it, and lets the reader read ahead.
void App::continue_playing() {
  if (!reader_) return;
  if (player_.advance(now_ms())) wake();
  const std::int64_t frame = player_.frame();
  const std::shared_ptr<const FrameMaker> maker = viewer_.frame_maker();
  if (frame == frame_in_viewer_) {
    if (frame_is_drawn_) player_.shown(now_ms());
    if (player_.next()) reader_->want(*player_.next(), std::nullopt, maker);
    return;
  }
  reader_->want(frame, player_.next(), maker);
  const std::optional<Result<std::shared_ptr<PreparedFrame>>> came = reader_->take(frame);
  if (!came) return;
  const Result<bool> shown = *came ? viewer_.show_frame(***came) : Result<bool>(came->error());
  if (!shown) {
    player_.start_anew(player_.frames(), frame_in_viewer_);
    return say(shown.error().to_string(), true);
  }
  if (!*shown) return;
  frame_in_viewer_ = frame;
  frame_is_drawn_ = false;
  panel_.table.forget();
  wake();
}

// --- Frame after frame ------------------------------------------------------------------------------------------

ImVec2 App::picture_size() const {
  const PixelSize pixels = window_->framebuffer();
  auto width = static_cast<float>(pixels.width), height = static_cast<float>(pixels.height);
  if (panel_shown_) {
    const auto per_unit = static_cast<float>(window_->pixels_per_unit());
    const auto [below, extent] = Panel::place({width / per_unit, height / per_unit}, window_->text_scale());
    (below ? height : width) -= extent * per_unit;
  }
  return {std::max(1.0F, width), std::max(1.0F, height)};
}

Status App::run() {
  FrameReport report;
  int settled_frames = 0;
  while (glfwWindowShouldClose(window_->handle()) == GLFW_FALSE) {
    if (frames_to_draw_ > 0 || !report.settled)
      glfwPollEvents();
    else
      glfwWaitEventsTimeout(
          std::max(kShortestWait, std::min(kIdleSeconds, player_.wait_ms(now_ms()).value_or(1e9) / 1000)));
    continue_playing();
    const PixelSize pixels = window_->framebuffer();
    if (pixels.width == 0 || pixels.height == 0) {
      // Minimized.
      glfwWaitEventsTimeout(kIdleSeconds);
      continue;
    }
    const ImVec2 size = picture_size();
    viewer_.resize(static_cast<int>(size.x), static_cast<int>(size.y));

    // Continue the picture, and update the panel's numbers.
    const Result<FrameReport> next = viewer_.frame(kBudgetMs);
    if (next)
      report = *next;
    else
      say(next.error().to_string(), true);
    if (report.drawn && viewer_.settings().engine == ViewerEngine::cpu) texture_->take(viewer_.image());
    if (report.drawn) frame_is_drawn_ = true;
    if (panel_shown_ && !player_.playing()) panel_.table.update(viewer_, report.settled);

    // Draw the window if something in it is new.
    if (frames_to_draw_ == 0 && report.settled && !report.drawn) continue;
    frames_to_draw_ = std::max(0, frames_to_draw_ - 1);
    settled_frames = report.settled ? settled_frames + 1 : 0;
    constexpr int kFramesOfScreenshot = 4;
    Image screenshot;
    const bool is_screenshot = !request_.screenshot.empty() && settled_frames >= kFramesOfScreenshot;
    draw(report, is_screenshot ? &screenshot : nullptr);
    if (is_screenshot) return write_png(request_.screenshot, screenshot, {});
    if (!request_.screenshot.empty()) wake();
    if (report.settled && report.drawn) wake();

    // Open a dropped file after its name is on the screen.
    if (!file_to_open_) continue;
    const std::string path = *std::exchange(file_to_open_, std::nullopt);
    open_file(path);
    if (std::exchange(dropped_several_, false) && message_.empty())
      say("several files were dropped; this is the first", false);
    wake();
  }
  return Done{};
}

void App::draw(const FrameReport& report, Image* screenshot) {
  const ImVec2 size = picture_size();
  const auto unit = static_cast<float>(1 / window_->pixels_per_unit());
  const PixelSize pixels = window_->framebuffer();
  const Gl& gl = window_->gl();
  gl.Viewport(0, 0, pixels.width, pixels.height);
  gl.ClearColor(kBackground.x, kBackground.y, kBackground.z, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  window_->begin_frame();
  if (viewer_.settings().engine == ViewerEngine::gpu)
    // OpenGL counts from the lower border.
    viewer_.show(0, {0, pixels.height - static_cast<int>(size.y), static_cast<int>(size.x), static_cast<int>(size.y)});
  else
    texture_->draw({size.x * unit, size.y * unit});
  PanelRequests requests;
  if (panel_shown_) requests = panel_.draw(viewer_, report, ImGui::GetIO().DisplaySize, window_->text_scale());
  PlayerRequests played;
  if (reader_)
    played = draw_player_bar(player_, viewer_.facts(), {size.x * unit, size.y * unit}, window_->text_scale());
  if (asked_file_)
    draw_prompt();
  else
    draw_message();
  window_->end_frame(screenshot);
  follow(requests);
  follow(played);
}

// A small window at the lower border of the picture; returns its width.
float App::begin_overlay(const char* name) const {
  const auto scale = static_cast<float>(window_->text_scale());
  const float margin = 14 * scale;
  const float across = picture_size().x / static_cast<float>(window_->pixels_per_unit()) - 2 * margin;
  const float width = std::max(across, 100 * scale);
  const float bar = reader_ ? player_bar_height(window_->text_scale()) : 0;
  const float lower = picture_size().y / static_cast<float>(window_->pixels_per_unit());
  ImGui::SetNextWindowPos({margin, lower - bar - margin}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width, ImGui::GetIO().DisplaySize.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * scale);
  ImGui::SetNextWindowBgAlpha(0.94F);
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  return width;
}

void App::end_overlay() {
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  overlay_min_ = corner;
  overlay_max_ = {corner.x + size.x, corner.y + size.y};
  ImGui::End();
  ImGui::PopStyleVar();
}

void App::draw_message() {
  const std::string text = file_to_open_ ? "opening " + *file_to_open_ : message_;
  if (text.empty()) return;
  const float width = begin_overlay("message");
  ImGui::PushTextWrapPos(width - ImGui::GetStyle().WindowPadding.x);
  ImGui::TextColored(file_to_open_ ? kDim : message_is_bad_ ? kBad : kGood, "%s", text.c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) message_.clear();
  end_overlay();
}

void App::draw_prompt() {
  const float width = begin_overlay("open");
  ImGui::TextColored(kDim, "a file of spheres or a scene file; Enter opens it, Esc does not");
  ImGui::PushTextWrapPos(width - ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted((*asked_file_ + "_").c_str());
  ImGui::PopTextWrapPos();
  end_overlay();
}

}  // namespace bihive::window
