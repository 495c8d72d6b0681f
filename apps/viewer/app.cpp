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
constexpr double kRestMs = 120;  // the pointer rests this long before its sphere is named

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
  search_.reset();
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
  cards_.reading = request_.reading;
  opened(viewer_.facts());
  framed_ = !request_.places_camera;
  if (request_.side) side_ = name_of(kSides, *request_.side);
  take_frames(std::move(first_frames_), request_.reading.options().frame);
  history_.begin(state());
  keep_recent();
  welcomes_ = request_.welcomes;
  if (!request_.card.empty()) open_card(request_.card);
  return Done{};
}

// --- Actions on events ------------------------------------------------------------------------------------------

void App::open_file(const std::string& path) {
  Result<LoadedFile> file = load_file(viewer_, path, {});
  if (!file) return say(file.error().to_string(), true);
  input_ = path;
  cards_.reading = {};
  opened(file->facts);
  take_frames(std::move(file->frames), 0);
  history_.begin(state());
  keep_recent();
}

void App::open_built_in(const std::string& name, const ScenarioParameters& parameters) {
  const Result<SceneFacts> facts = viewer_.load_built_in(name, parameters);
  if (facts) {
    input_ = name;
    cards_.reading = {};
    request_.scenario = parameters;
  }
  opened(facts);
  if (!facts) return;
  take_frames(nullptr, 0);
  history_.begin(state());
}

// The same input read in another way, with the same appearance and settings. A camera that was not moved is placed
// again.
void App::read_again(const GivenReading& wanted) {
  ReadOptions options = wanted.options();
  options.frame = reader_ ? frame_in_viewer_ : options.frame;
  const ViewerLook look = viewer_.look();
  ViewerSettings settings = viewer_.settings();
  ScenarioParameters scenario = request_.scenario;
  scenario.radius = options.radius ? scenario_radius(*options.radius) : ScenarioParameters{}.radius;
  std::shared_ptr<const Frames> frames;
  if (is_built_in_scene(input_)) {
    const Result<SceneFacts> loaded = viewer_.load_built_in(input_, scenario, options);
    if (!loaded) return say(loaded.error().to_string(), true);
  } else {
    Result<LoadedFile> loaded = load_file(viewer_, input_, options);
    if (!loaded) return say(loaded.error().to_string(), true);
    frames = std::move(loaded->frames);
  }
  cards_.reading = wanted;
  const std::string file_name = cards_.save.file_name;
  const bool framed = framed_;
  const std::optional<std::string> side = side_;
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
  take_frames(std::move(frames), options.frame);
  cards_.save.file_name = file_name;
  framed_ = framed;
  side_ = side;
  if (!words.empty()) say(words, true);
}

void App::opened(const Result<SceneFacts>& facts) {
  if (!facts) return say(facts.error().to_string(), true);
  end_work();
  message_.clear();
  tip_.reset();
  texture_->forget();
  cards_.begin(viewer_);
  framed_ = true;
  side_.reset();
  const std::filesystem::path name(facts->name);
  cards_.save.file_name = name.stem().string() + ".png";
  glfwSetWindowTitle(window_->handle(), (title_of(*facts) + " - bihive").c_str());
}

void App::apply(const ViewerSettings& settings) {
  const bool other_copies = settings.replicate != viewer_.settings().replicate;
  if (!same_tree(settings, viewer_.settings())) search_.reset();
  if (Status status = viewer_.set(settings); !status) return say(status.error().to_string(), true);
  if (message_is_bad_) message_.clear();
  if (other_copies) cards_.changed(viewer_, true);
}

void App::apply(const ViewerLook& look) {
  std::size_t failed_row = 0;
  const Result<std::vector<std::int64_t>> counts = viewer_.set_look(look, &failed_row);
  if (const std::string words = cards_.rows.answered(counts, failed_row); !words.empty()) return say(words, true);
  if (!counts) return;
  if (message_is_bad_) message_.clear();
  cards_.changed(viewer_, false);
}

// A screenshot leaves no trace.
void App::keep_recent() {
  if (request_.screenshot.empty() && !is_built_in_scene(input_)) recent_.add(input_);
  cards_.file.recent = recent_.paths();
}

void App::zoom(double factor) {
  const ImVec2 size = picture_size();
  framed_ = false;
  viewer_.zoom(factor, size.x / 2.0, size.y / 2.0);
}

void App::home() {
  framed_ = true;
  side_.reset();
  viewer_.home();
}

void App::follow(const CardRequests& requests) {
  if (requests.look) apply(*requests.look);
  if (requests.settings) apply(*requests.settings);
  if (requests.side) {
    viewer_.look_from(*requests.side);
    framed_ = true;
    side_ = name_of(kSides, *requests.side);
  }
  if (requests.home) home();
  if (requests.zoom != 1) zoom(requests.zoom);
  if (requests.reading) read_again(*requests.reading);
  if (requests.open.built_in) open_built_in(*requests.open.built_in, {});
  if (requests.open.count) {
    ScenarioParameters parameters = request_.scenario;
    parameters.count = *requests.open.count;
    open_built_in(input_, parameters);
  }
  if (requests.open.file) {
    file_to_open_ = *requests.open.file;
    cards_.close();
  }
  if (requests.open.forget) {
    recent_.forget();
    cards_.file.recent.clear();
  }
  if (requests.copy) copy_command(*requests.copy);
  if (requests.save) begin_save();
  if (requests.tune) begin_search();
  if (requests.help) help_shown_ = true;
  if (requests.undo != 0) undo(requests.undo);
}

// Another frame is no other state.
ShownState App::state() const {
  ShownState state;
  state.input = input_;
  for (const BuiltInScene& one : kBuiltInScenes)
    if (input_ == one.name && one.kind == BuiltInKind::scenario) {
      const ScenarioParameters usual;
      if (request_.scenario.count != usual.count) state.count = request_.scenario.count;
      if (request_.scenario.seed != usual.seed) state.seed = request_.scenario.seed;
    }
  state.reading = cards_.reading;
  state.settings = viewer_.settings();
  state.look = viewer_.look();
  state.own_camera = framed_;
  state.side = side_;
  const ImVec2 screen = picture_size();
  const PictureSizePx size = cards_.save.size({static_cast<int>(screen.x), static_cast<int>(screen.y)});
  state.width_px = size.width;
  state.height_px = size.height;
  return state;
}

void App::note_state() {
  history_.note(state(), frames_of_act_ > 0, now_ms());
  frames_of_act_ = std::max(0, frames_of_act_ - 1);
}

void App::undo(int by) {
  const std::string what = history_.next(by);
  const ShownState* const before = history_.go(by);
  if (before == nullptr) return say(by < 0 ? "nothing to undo" : "nothing to redo", false);
  const ShownState wanted = *before;
  message_.clear();
  if (reading_to_json(wanted.reading) != reading_to_json(cards_.reading)) read_again(wanted.reading);
  const bool other_copies = wanted.settings.replicate != viewer_.settings().replicate;
  const Result<std::vector<std::int64_t>> counts = viewer_.set_look(wanted.look);
  const Status set = counts ? viewer_.set(wanted.settings) : Status(counts.error());
  cards_.rows.start_anew(viewer_.look());
  cards_.changed(viewer_, other_copies);
  search_.reset();
  framed_ = wanted.own_camera;
  side_ = wanted.side;
  frames_of_act_ = 0;
  if (message_is_bad_ && !message_.empty()) return;
  say(set ? (by < 0 ? "undone: " : "redone: ") + what : set.error().to_string(), !set);
}

std::string App::command(CommandOf kind) const {
  ShownState shown = state();
  if (reader_ && (frame_in_viewer_ > 0 || shown.reading.has("frame"))) shown.reading.set_frame(frame_in_viewer_);
  const std::filesystem::path output(cards_.save.file_name);
  return command_text(kind, shown, (output.parent_path() / output.stem()).string());
}

void App::copy_command(CommandOf kind) {
  const std::string text = command(kind);
  glfwSetClipboardString(window_->handle(), text.c_str());
  say("copied: " + text, false);
}

void App::say(const std::string& text, bool bad) {
  message_ = text;
  message_is_bad_ = bad;
  wake();
}

// --- Long work --------------------------------------------------------------------------------------------------

void App::begin_save() {
  const ImVec2 screen = picture_size();
  const PictureSizePx size = cards_.save.size({static_cast<int>(screen.x), static_cast<int>(screen.y)});
  const Status begun = viewer_.begin_picture(size.width, size.height, samples_at_rest(viewer_.settings()));
  if (!begun) return say(begun.error().to_string(), true);
  save_ = Save{free_name(cards_.save.file_name),
               {{"Software", "bihive " + std::string(version())},
                {"Scene", viewer_.facts().name},
                {"Settings", settings_to_json(viewer_.settings())},
                {"Look", viewer_look_to_json(viewer_.look())}}};
  if (reader_) save_->text.emplace_back("Frame", std::to_string(frame_in_viewer_));
  message_.clear();
}

void App::continue_save() {
  const Result<double> done = viewer_.advance_picture(4 * kBudgetMs);
  if (!done) {
    save_.reset();
    return say(done.error().to_string(), true);
  }
  save_->done = *done;
  if (*done >= 1) finish_save();
}

void App::finish_save() {
  const Save save = *std::exchange(save_, std::nullopt);
  const Result<PngPixels> picture = viewer_.take_picture();
  viewer_.drop_picture();
  if (!picture) return say(picture.error().to_string(), true);
  const Result<std::string> png = encode_png(*picture, save.text);
  if (!png) return say(png.error().to_string(), true);
  if (Status status = write_file(save.path, *png); !status) return say(status.error().to_string(), true);
  std::error_code ignored;
  say(fmt::format("saved {} ({} x {})", std::filesystem::absolute(save.path, ignored).string(), picture->width,
                  picture->height),
      false);
}

void App::begin_search() {
  request_.tune = false;
  if (needs_reference_tree(viewer_.settings()))
    return say("the limits of the CPU engine's own tree are searched, and this view or engine has another one", true);
  search_ = std::make_unique<TreeSearch>(viewer_.scene(), viewer_.settings(), [] { glfwPostEmptyEvent(); });
}

void App::take_search() {
  const Result<TunedTree> found = search_->result();
  search_.reset();
  if (!found) return say(found.error().to_string(), true);
  ViewerSettings settings = viewer_.settings();
  settings.max_prims = found->tree.max_prims;
  settings.max_depth = found->tree.max_depth;
  apply(settings);
  act();
  say(found->text(), false);
}

void App::end_work() {
  if (std::exchange(save_, std::nullopt)) {
    viewer_.drop_picture();
    say("the picture was cancelled", false);
  } else if (search_) {
    say("the search of the tree's limits was cancelled: they stay", false);
  }
  search_.reset();
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
  cards_.moved(viewer_);
  wake();
}

// --- Frame after frame ------------------------------------------------------------------------------------------

Layout App::layout() const {
  const PixelSize pixels = window_->framebuffer();
  const auto per_unit = static_cast<float>(window_->pixels_per_unit());
  const ImVec2 display{static_cast<float>(pixels.width) / per_unit, static_cast<float>(pixels.height) / per_unit};
  Layout now = cards_.layout(display, window_->text_scale(), per_unit, controls_shown_);
  if (reader_ && player_bar_is_wide(now.picture.x, window_->text_scale()))
    now.lower -= player_bar_height(now.picture.x, window_->text_scale());
  return now;
}

ImVec2 App::picture_size() const {
  return layout().picture_px;
}

double App::wait_s() const {
  double wait = std::min(1000 * kIdleSeconds, player_.wait_ms(now_ms()).value_or(1e9));
  if (rests_since_ms_) wait = std::min(wait, *rests_since_ms_ + kRestMs - now_ms());
  return std::max(kShortestWait, wait / 1000);
}

Status App::run() {
  FrameReport report;
  int settled_frames = 0;
  while (glfwWindowShouldClose(window_->handle()) == GLFW_FALSE) {
    if (frames_to_draw_ > 0 || !report.settled || save_)
      glfwPollEvents();
    else
      glfwWaitEventsTimeout(wait_s());
    turn();
    if (search_ && search_->finished()) take_search();
    if (search_ && std::exchange(search_shown_, search_->done()) != search_->done()) wake();
    if (rests_since_ms_ && now_ms() - *rests_since_ms_ >= kRestMs) {
      rests_since_ms_.reset();
      tip_ = Pins::named(viewer_, x_ * window_->pixels_per_unit(), y_ * window_->pixels_per_unit());
      if (tip_) wake();
    }
    const PixelSize pixels = window_->framebuffer();
    if (pixels.width == 0 || pixels.height == 0) {
      // Minimized.
      glfwWaitEventsTimeout(kIdleSeconds);
      continue;
    }
    if (save_) {
      // No frames are drawn meanwhile, and none is played.
      continue_save();
      draw(report, nullptr);
      continue;
    }
    continue_playing();
    const ImVec2 size = picture_size();
    viewer_.resize(static_cast<int>(size.x), static_cast<int>(size.y));

    // Continue the picture, and update the numbers of the trees.
    const Result<FrameReport> next = viewer_.frame(kBudgetMs);
    if (next)
      report = *next;
    else
      say(next.error().to_string(), true);
    if (report.drawn && viewer_.settings().engine == ViewerEngine::cpu) texture_->take(viewer_.image());
    if (report.drawn) frame_is_drawn_ = true;
    if (cards_.open() == "more" && !player_.playing()) cards_.table.update(viewer_, report.settled);
    if (request_.tune && report.settled) begin_search();

    // Draw the window if something in it is new.
    if (frames_to_draw_ == 0 && report.settled && !report.drawn) continue;
    frames_to_draw_ = std::max(0, frames_to_draw_ - 1);
    settled_frames = report.settled && !search_ ? settled_frames + 1 : 0;
    constexpr int kFramesOfScreenshot = 4;
    Image screenshot;
    const bool is_screenshot = !request_.screenshot.empty() && settled_frames >= kFramesOfScreenshot;
    draw(report, is_screenshot ? &screenshot : nullptr);
    if (is_screenshot) return write_png(request_.screenshot, screenshot, {});
    if (!request_.screenshot.empty() && !search_) wake();
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
  const Layout now = layout();
  const ImVec2 size = now.picture_px;
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
    texture_->draw({size.x / now.per_unit(), size.y / now.per_unit()});
  covered_.clear();
  CardRequests requests;
  const std::string open = cards_.open();
  cards_.searches = search_ != nullptr;
  cards_.undoes = history_.next(-1);
  cards_.redoes = history_.next(1);
  if (cards_.open() == "share") cards_.command = command(cards_.command_of);
  if (controls_shown_) requests = cards_.draw(viewer_, report, now, input_, covered_);
  PlayerRequests played;
  if (reader_) played = draw_player_bar(player_, viewer_.facts(), now.picture, window_->text_scale(), covered_);
  draw_overlays(now, requests);
  popup_open_ = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  window_->end_frame(screenshot);
  if (open != cards_.open()) wake();
  follow(requests);
  follow(played);
  note_state();
}

}  // namespace bihive::window
