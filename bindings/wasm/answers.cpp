#include "answers.h"

#include <emscripten/bind.h>

#include "bihive/base/parallel.h"
#include "bihive/base/version.h"

namespace bihive::page {
namespace {

using nlohmann::ordered_json;

std::string version_text() {
  return version_with_commit(version(), commit());
}

}  // namespace

std::string text_of(const ordered_json& json) {
  const std::string folder = kFolder;
  std::string text = json.dump(-1, ' ', /*ensure_ascii=*/false, ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
    text.erase(at, folder.size());
  return text;
}

ordered_json failure_json(const Error& error) {
  return {{"error",
           {{"message", error.message},
            {"file", error.file},
            {"line", error.line},
            {"column", error.column},
            {"hint", error.hint}}}};
}

std::string failure(const Error& error) {
  return text_of(failure_json(error));
}

std::vector<std::uint8_t> pixels_of(const Image& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::vector<std::uint8_t> bytes(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) bytes[4 * i + channel] = image.rgb[3 * i + channel];
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

}  // namespace bihive::page

EMSCRIPTEN_BINDINGS(answers) {
  emscripten::function("version", &bihive::page::version_text);
  emscripten::function("threads", &bihive::hardware_threads);
}
