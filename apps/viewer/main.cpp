// bihive-view, the window: started by `bihive view` with a request (request.h).

#include <cstdio>
#include <exception>
#include <string>

#include "app.h"
#include "bihive/base/write_file.h"
#include "bihive/scene/load_scene.h"

namespace bihive::window {
namespace {

enum ExitCode : int { kSuccess = 0, kBadInput = 1, kBadUsage = 2, kEnvironment = 3 };

int fail(const Error& error, ExitCode code) {
  std::fprintf(stderr, "bihive: error: %s\n", error.to_string().c_str());
  return code;
}

Result<SceneFacts> load(Viewer& viewer, const Request& request) {
  if (is_built_in_scene(request.input)) return viewer.load_built_in(request.input, request.scenario, request.reading);
  const Result<std::string> bytes = read_file(request.input);
  if (!bytes) return bytes.error();
  return viewer.load(*bytes, request.input, request.reading);
}

int run(int argc, char** argv) {
  if (argc != 2) return fail({"this program is started by `bihive view`", "", 0, 0, ""}, kBadUsage);
  const Result<Request> request = request_from_json(argv[1]);
  if (!request) return fail(request.error(), kBadUsage);
  if (!request->screenshot.empty())
    if (const Status status = check_writable(request->screenshot); !status) return fail(status.error(), kBadInput);
  Viewer viewer;
  const Result<SceneFacts> facts = load(viewer, *request);
  if (!facts) return fail(facts.error(), kBadInput);
  for (const std::string& warning : facts->warnings) std::fprintf(stderr, "bihive: warning: %s\n", warning.c_str());
  App app(viewer, *request);
  if (const Status status = app.open(); !status) return fail(status.error(), kEnvironment);
  if (const Status status = app.run(); !status) return fail(status.error(), kBadInput);
  return kSuccess;
}

}  // namespace
}  // namespace bihive::window

int main(int argc, char** argv) {
  try {
    return bihive::window::run(argc, argv);
  } catch (const std::exception& error) {
    return bihive::window::fail({error.what(), "", 0, 0, ""}, bihive::window::kBadInput);
  }
}
