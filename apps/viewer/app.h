// The window's program: it connects the viewer and the user.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/io/frames.h"
#include "bihive/viewer/history.h"
#include "bihive/viewer/player.h"
#include "bihive/viewer/recent_files.h"
#include "bihive/viewer/viewer.h"
#include "cards.h"
#include "frame_reader.h"
#include "picture_texture.h"
#include "player_bar.h"
#include "request.h"
#include "tree_search.h"
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
  // Events of the window (app_events.cpp).
  static void listen(GLFWwindow* window);
  void on_key(int key, int action, int mods);
  void on_letter(char letter);
  void on_path_key(int key, int mods);
  void on_escape();
  void on_character(unsigned character);
  void on_button(int button, int action, int mods);
  void on_click();
  void on_cursor(double x, double y);
  void on_wheel(double dy);
  bool over_picture() const;
  void turn();
  void on_drop(std::vector<std::string> paths);
  void wake() { frames_to_draw_ = 3; }
  /// The user has done something, of which a state of the next frames may come.
  void act() { frames_of_act_ = 3; }
  bool types_path() const;
  void pin(double x_px, double y_px);
  void approach(double x_px, double y_px);

  // Actions on events.
  void open_file(const std::string& path);
  void open_built_in(const std::string& name, const ScenarioParameters& parameters);
  void read_again(const GivenReading& reading);
  void opened(const Result<SceneFacts>& facts);
  void apply(const ViewerSettings& settings);
  void apply(const ViewerLook& look);
  void follow(const CardRequests& requests);
  void zoom(double factor);
  void home();
  void keep_recent();
  void say(const std::string& text, bool bad);
  ShownState state() const;
  void note_state();
  void undo(int by);
  std::string command(CommandOf kind) const;
  void copy_command(CommandOf kind);
  void open_card(const std::string& id) { cards_.show(id, input_); }

  // Long work, which is shown and can be ended.
  void begin_save();
  void continue_save();
  void finish_save();
  void begin_search();
  void take_search();
  void end_work();

  // The player.
  void take_frames(std::shared_ptr<const Frames> frames, std::int64_t frame);
  void toggle_play();
  void step_frames(int by);
  void go_to(std::int64_t frame);
  void continue_playing();
  void follow(const PlayerRequests& requests);

  // Frame after frame.
  Layout layout() const;
  ImVec2 picture_size() const;  // in pixels
  double wait_s() const;
  void draw(const FrameReport& report, Image* screenshot);
  void draw_overlays(const Layout& layout, CardRequests& requests);
  void begin_overlay(const char* name, ImVec2 corner, ImVec2 pivot, float width);
  void end_overlay();
  void draw_message(const Layout& layout);
  void draw_work(const Layout& layout);
  void draw_welcome(const Layout& layout, CardRequests& requests);
  void draw_help(const Layout& layout);
  void draw_tip(const Layout& layout);

  Viewer& viewer_;
  Request request_;
  std::string input_;   // shown: a built-in name or a file
  bool framed_ = true;  // the camera was not moved since it showed the whole scene, or was the scene's own
  std::optional<std::string>
      side_;  // the camera shows the whole scene from this side; none: the scene's own camera, or the front
  std::unique_ptr<Window> window_;
  std::unique_ptr<PictureTexture> texture_;
  Cards cards_;
  std::shared_ptr<const Frames> first_frames_;
  Player player_;
  std::unique_ptr<FrameReader> reader_;  // null: the scene has one frame
  std::int64_t frame_in_viewer_ = 0;
  bool frame_is_drawn_ = true;  // the requested frame
  bool controls_shown_ = true;
  bool help_shown_ = false;
  bool welcomes_ = false;
  std::string message_;
  bool message_is_bad_ = false;
  std::optional<std::string> file_to_open_;
  bool dropped_several_ = false;
  bool path_is_new_ = false;  // the letter of the key that opened the card comes after that key
  int frames_to_draw_ = 3;    // frames of the window still to draw, at least
  RecentFiles recent_{RecentFiles::usual_list()};
  History history_;        // undo states of the shown scene
  int frames_of_act_ = 0;  // while above 0, changes count as made by the user

  struct Save {
    std::string path;
    std::vector<std::pair<std::string, std::string>> text;  // text chunks of the PNG file
    double done = 0;
  };
  std::optional<Save> save_;  // being drawn
  std::unique_ptr<TreeSearch> search_;
  double search_shown_ = 0;  // its progress as last drawn

  enum class Drag { none, orbit, pan };
  Drag drag_ = Drag::none;
  double x_ = 0, y_ = 0;                // position of the pointer
  double turned_x_ = 0, turned_y_ = 0;  // pixels that the pointer has turned the scene by, since the last turn()
  double down_x_ = 0, down_y_ = 0;      // position at which a button went down
  bool may_be_click_ = false;           // it has not moved since
  double last_click_ms_ = -1e9;
  std::optional<double> rests_since_ms_;  // the pointer, over the picture, without a name yet
  std::optional<NamedSphere> tip_;
  Covered covered_;
  bool popup_open_ = false;
};

}  // namespace bihive::window
