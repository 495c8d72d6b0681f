// The window's program: it connects the viewer and the user.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/io/frames.h"
#include "bihive/viewer/player.h"
#include "bihive/viewer/viewer.h"
#include "frame_reader.h"
#include "panel.h"
#include "picture_texture.h"
#include "player_bar.h"
#include "request.h"
#include "window.h"

struct GLFWwindow;

namespace bihive::window {

class App {
 public:
  /// The viewer has the scene of the request, with its appearance and settings except the engine. `frames`: of the
  /// request's file; null: a single frame.
  App(Viewer& viewer, const Request& request, std::shared_ptr<const Frames> frames)
      : viewer_(viewer), request_(request), input_(request.input), first_frames_(std::move(frames)) {}
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  /// Error: no window, no OpenGL, or no graphics processor although the request asks for one.
  Status open();
  /// Runs until the window is closed or the screenshot is written. Error: it could not be written.
  Status run();

 private:
  // Events of the window.
  static void listen(GLFWwindow* window);
  void on_key(int key, int action, int mods);
  void on_prompt_key(int key, int mods);
  void on_character(unsigned character);
  void on_button(int button, int action, int mods);
  void on_cursor(double x, double y);
  void on_wheel(double dy);
  bool over_picture() const;
  void on_drop(std::vector<std::string> paths);
  void wake() { frames_to_draw_ = 3; }

  // Actions on events.
  void open_file(const std::string& path);
  void open_built_in(const std::string& name);
  void read_again(const ReadOptions& wanted);
  void opened(const Result<SceneFacts>& facts);
  void apply(const ViewerSettings& settings);
  void apply(const ViewerLook& look);
  void follow(const PanelRequests& requests);
  void save();

  // The player.
  void take_frames(std::shared_ptr<const Frames> frames, std::int64_t frame);
  void toggle_play();
  void step_frames(int by);
  void go_to(std::int64_t frame);
  void continue_playing();
  void follow(const PlayerRequests& requests);
  Result<PngPixels> picture_to_save();
  void say(const std::string& text, bool bad);

  void draw(const FrameReport& report, Image* screenshot);
  float begin_overlay(const char* name) const;
  void end_overlay();
  void draw_message();
  void draw_prompt();
  ImVec2 picture_size() const;  // in ImGui's units

  Viewer& viewer_;
  Request request_;
  std::string input_;   // shown: a built-in name or a file
  bool framed_ = true;  // the camera was not moved since it showed the whole scene, or was the scene's own
  std::unique_ptr<Window> window_;
  std::unique_ptr<PictureTexture> texture_;
  Panel panel_;
  std::shared_ptr<const Frames> first_frames_;
  Player player_;
  std::unique_ptr<FrameReader> reader_;  // null: the scene has one frame
  std::int64_t frame_in_viewer_ = 0;
  bool frame_is_drawn_ = true;  // the requested frame
  bool panel_shown_ = true;
  std::string message_;
  bool message_is_bad_ = false;
  std::optional<std::string> file_to_open_;
  bool dropped_several_ = false;
  std::optional<std::string> asked_file_;  // being typed
  bool prompt_is_new_ = false;
  int frames_to_draw_ = 3;  // of the window, at least

  enum class Drag { none, orbit, pan };
  Drag drag_ = Drag::none;
  double x_ = 0, y_ = 0;                                // of the pointer
  ImVec2 overlay_min_ = {0, 0}, overlay_max_ = {0, 0};  // the message or the prompt, as last drawn, in ImGui's units
};

}  // namespace bihive::window
