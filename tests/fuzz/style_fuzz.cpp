// parse_style() on any bytes: a look that a scene takes, or an error in one line with its place.
#include <string_view>

#include "bihive/io/read_spheres.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"
#include "engines.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  static const auto spheres = read_spheres_from_memory("3\n\nC 0 0 0\nO 1 0 0\nN 0 2 0\n", "a.xyz", {});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<Style> style = parse_style(text, "fuzz.json");
  if (!style) {
    fuzz::demand(!style.error().message.empty() && printable(style.error().message) == style.error().message);
    return 0;
  }
  Scene scene;
  scene.spheres = spheres->spheres;
  apply_style(*style, scene);
  // The style makes a scene that can be written and read.
  fuzz::demand(parse_scene(scene_to_json(scene), "fuzz/none.json", {}).ok());
  return 0;
}
