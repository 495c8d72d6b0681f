// bihive-view, the window: started by `bihive view` with a request (request.h).

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "../shared/last_line.h"
#include "app.h"
#include "bihive/base/readable.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/write_file.h"
#include "bihive/scene/load_scene.h"
#include "bihive/viewer/load_file.h"
#include "bihive/viewer/viewer_json.h"
#include "shown_frames_window.h"

namespace bihive::window {
namespace {

enum ExitCode : int { kSuccess = 0, kBadInput = 1, kBadUsage = 2, kEnvironment = 3 };

// Before the shared libraries make their variables, some of which need memory. The window leaves no unfinished file.
void prepare() {
  end_in_one_line(nullptr);
}
__attribute__((section(".preinit_array"), used)) void (*const kFirst)() = prepare;

// File names and other texts of users may contain anything.
void say(const char* kind, const std::string& text) {
  std::fprintf(stderr, "bihive: %s: %s\n", kind, escaped(text).c_str());
}

int fail(const Error& error, ExitCode code) {
  say("error", error.to_string());
  return code;
}

Result<LoadedFile> load(Viewer& viewer, const Request& request) {
  if (!is_built_in_scene(request.input)) return load_file(viewer, request.input, request.reading.options());
  Result<SceneFacts> facts = viewer.load_built_in(request.input, request.scenario, request.reading.options());
  if (!facts) return facts.error();
  return LoadedFile{std::move(*facts), nullptr};
}

// The requested look and settings; the window sets the engine.
Status choose(Viewer& viewer, const Request& request) {
  const Result<ViewerLook> look = viewer_look_from_json(request.look, viewer.look());
  if (!look) return look.error();
  if (*look != viewer.look())
    if (const auto shown = viewer.set_look(*look); !shown) return shown.error();
  if (request.side) viewer.look_from(*request.side);
  Result<ViewerSettings> settings = settings_from_json(request.settings, viewer.settings());
  if (!settings) return settings.error();
  settings->engine = ViewerEngine::cpu;
  return viewer.set(*settings);
}

int run(int argc, char** argv) {
  name_settings_by(&option_of_setting);
  if (argc != 2) return fail({"this program is started by `bihive view`", "", 0, 0, ""}, kBadUsage);
  const Result<Request> request = request_from_json(argv[1]);
  if (!request) return fail(request.error(), kBadUsage);
  if (!request->shown_frames.empty()) {
    if (const Status status = check_writable(request->shown_frames); !status) return fail(status.error(), kBadInput);
    const Result<std::string> json = measure_shown_frames(request->seconds);
    if (!json) return fail(json.error(), kEnvironment);
    const Status status = write_file(request->shown_frames, *json);
    return status ? kSuccess : fail(status.error(), kBadInput);
  }
  if (!request->screenshot.empty())
    if (const Status status = check_writable(request->screenshot); !status) return fail(status.error(), kBadInput);
  Viewer viewer;
  Result<LoadedFile> file = load(viewer, *request);
  if (!file) return fail(file.error(), kBadInput);
  for (const std::string& warning : file->facts.warnings) say("warning", warning);
  if (const Status status = choose(viewer, *request); !status) return fail(status.error(), kBadUsage);
  App app(viewer, *request, std::move(file->frames));
  if (const Status status = app.open(); !status) return fail(status.error(), kEnvironment);
  if (const Status status = app.run(); !status) return fail(status.error(), kBadInput);
  return kSuccess;
}

}  // namespace
}  // namespace bihive::window

int main(int argc, char** argv) {
  try {
    return bihive::window::run(argc, argv);
  } catch (const std::bad_alloc&) {
    bihive::say_no_memory();
  } catch (const std::exception& error) {
    bihive::say_without_memory(error.what());
  }
  return bihive::window::kBadInput;
}
