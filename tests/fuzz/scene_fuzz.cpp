// parse_scene() on any bytes: an answer or an error, never a crash. A scene that it writes again is read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "bihive/scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto loaded = bihive::parse_scene(bytes, "fuzz/none.json", {});
  if (!loaded) return 0;
  const std::string written = bihive::scene_to_json(loaded->scene);
  if (!bihive::parse_scene(written, "fuzz/none.json", {})) std::abort();
  return 0;
}
