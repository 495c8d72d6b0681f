// gl_compare INPUT PICTURE.png [options]: how far a picture of another renderer is from the CPU's, as JSON.
//
// INPUT: scenario1, scenario2, scenario3, four-spheres, demo, a scene file or a file of spheres; camera and light are
// those of `bihive render` unless options say otherwise. The picture's size is the PNG's. Options: --recursion N
// --samples N --view NAME --transfer srgb|none --shadows 0|1 --max-prims N --count N --fov DEG --eye X,Y,Z
// --look-at X,Y,Z --up X,Y,Z, and --cpu FILE.png, which writes the CPU's picture. Prints {"pixels", "differing",
// "share", "off_edge", "largest", "examples"}. Exit code 1: something cannot be read; 2: bad usage.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "bihive/base/write_file.h"
#include "bihive/image/png.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/load_scene.h"
#include "support/picture_agreement.h"

namespace bihive {
namespace {

template <class T>
T must(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "gl_compare: %s\n", result.error().to_string().c_str());
  std::exit(1);
}

[[noreturn]] void bad_usage(const std::string& what) {
  std::fprintf(stderr, "gl_compare: %s\n", what.c_str());
  std::exit(2);
}

Vec3d vector_of(const std::string& text) {
  Vec3d v;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf", &v.x, &v.y, &v.z) != 3) bad_usage("expected X,Y,Z, found " + text);
  return v;
}

LoadedScene load(const std::string& name, std::int64_t count) {
  if (is_built_in_scene(name)) return must(built_in_scene(name, {count, 1, 1}));
  return must(load_scene(must(read_file(name)), name));
}

int run(int argc, char** argv) {
  if (argc < 3 || argc % 2 == 0) bad_usage("expected INPUT PICTURE.png [--option value ...]");
  std::map<std::string, std::string> options{{"--count", "4096"}, {"--max-prims", "8"}, {"--view", "shaded"}};
  for (int i = 3; i < argc; i += 2) options[argv[i]] = argv[i + 1];
  const auto take = [&](const std::string& name, const auto& use) {
    const auto found = options.find(name);
    if (found == options.end()) return;
    use(found->second);
    options.erase(found);
  };
  std::int64_t count = 0, max_prims = 0;
  take("--count", [&](const std::string& text) { count = std::stoll(text); });
  take("--max-prims", [&](const std::string& text) { max_prims = std::stoll(text); });

  // The scene as `bihive render` would draw it.
  const Image other = must(read_png(argv[2])).image;
  LoadedScene loaded = load(argv[1], count);
  Scene& scene = loaded.scene;
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = other.width;
  settings.height_px = other.height;
  take("--recursion", [&](const std::string& text) { settings.recursion = std::stoi(text); });
  take("--samples", [&](const std::string& text) { settings.samples_per_pixel = std::stoi(text); });
  take("--shadows", [&](const std::string& text) { settings.shadows = text != "0"; });
  take("--transfer",
       [&](const std::string& text) { scene.picture.transfer = text == "none" ? Transfer::none : Transfer::srgb; });
  take("--view", [&](const std::string& text) {
    const std::map<std::string, View> views{{"shaded", View::shaded},       {"recursion", View::recursion},
                                            {"traversal", View::traversal}, {"normal", View::normal},
                                            {"distance", View::distance},   {"id", View::id}};
    const auto view = views.find(text);
    if (view == views.end()) bad_usage("there is no view " + text);
    settings.view = view->second;
  });
  take("--fov", [&](const std::string& text) { scene.camera.fov_deg = std::stod(text); });
  if (!loaded.has_camera)
    scene.camera =
        frame_spheres(scene.spheres, ViewFrom::front, scene.camera.fov_deg, settings.width_px, settings.height_px);
  take("--eye", [&](const std::string& text) { scene.camera.eye = vector_of(text); });
  take("--look-at", [&](const std::string& text) { scene.camera.look_at = vector_of(text); });
  take("--up", [&](const std::string& text) { scene.camera.up = vector_of(text); });
  if (!loaded.has_lights) scene.lights = {light_behind(scene.camera)};
  std::string cpu_path;
  take("--cpu", [&](const std::string& text) { cpu_path = text; });
  if (!options.empty()) bad_usage("there is no option " + options.begin()->first);

  const Tracer tracer = must(Tracer::build(scene.spheres, Engine::reference, {max_prims, kUnlimited}));
  const Image cpu = image_from_film(must(render(scene, tracer, settings)).film, settings.view, scene.picture.transfer);
  if (!cpu_path.empty()) must(write_png(cpu_path, cpu, {}));
  const test::Agreement agreement = test::agreement_of(scene, tracer, settings, cpu, other);
  const nlohmann::ordered_json json{{"pixels", agreement.pixels},   {"differing", agreement.differing},
                                    {"share", agreement.share()},   {"off_edge", agreement.off_edge},
                                    {"largest", agreement.largest}, {"examples", agreement.examples}};
  std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

}  // namespace
}  // namespace bihive

int main(int argc, char** argv) {
  return bihive::run(argc, argv);
}
