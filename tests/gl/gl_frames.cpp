// gl_frames INPUT [WIDTH HEIGHT [RECURSION]]: measures the time of a frame on the graphics processor, one sample a
// pixel.
//
// INPUT as for `bihive render`. Prints one JSON object: the processor, the time before the first frame (packing, and
// upload with linking the shaders), the first frame (many drivers compile then), and the median and the fastest of 15
// more, with rays of all kinds a frame.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/base/write_file.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/load_scene.h"
#include "support/gl_picture.h"

namespace bihive {
namespace {

constexpr int kFrames = 15;

int run(int argc, char** argv) {
  if (argc != 2 && argc != 4 && argc != 5) {
    std::fprintf(stderr, "gl_frames: expected INPUT [WIDTH HEIGHT [RECURSION]]\n");
    return 2;
  }
  const auto must = [](auto result) { return test::GlPictures::must(std::move(result)); };
  const std::string name = argv[1];
  LoadedScene loaded =
      is_built_in_scene(name) ? must(built_in_scene(name)) : must(load_scene(must(read_file(name)), name));
  Scene& scene = loaded.scene;
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = argc > 2 ? std::atoi(argv[2]) : 640;
  settings.height_px = argc > 2 ? std::atoi(argv[3]) : 360;
  settings.recursion = argc > 4 ? std::atoi(argv[4]) : settings.recursion;
  settings.samples_per_pixel = 1;
  if (!loaded.has_camera)
    scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, settings.width_px, settings.height_px);
  if (!loaded.has_lights) scene.lights = {light_behind(scene.camera)};
  const Tree tree = build_reference_tree(scene.spheres, {});

  const EglContext context = must(EglContext::create());
  GlRenderer renderer = must(GlRenderer::create(context.functions()));
  const Timer setting;
  must(renderer.set_scene(scene, &tree));
  const double set_ms = setting.elapsed_ms();
  const auto frame_ms = [&] {
    const Timer timer;
    must(renderer.begin(scene.camera, settings));
    while (!renderer.finished()) must(renderer.advance(100));
    return timer.elapsed_ms();
  };
  const double first_ms = frame_ms();
  std::vector<double> ms;
  for (int i = 0; i < kFrames; ++i) ms.push_back(frame_ms());
  std::sort(ms.begin(), ms.end());
  const GlRenderer::Picture picture = must(renderer.read());
  const nlohmann::ordered_json json{
      {"gpu", renderer.description()},
      {"input", name},
      {"spheres", scene.spheres.size()},
      {"size", std::to_string(settings.width_px) + "x" + std::to_string(settings.height_px)},
      {"recursion", settings.recursion},
      {"shadows", settings.shadows},
      {"rays", picture.primary + picture.others},
      {"set_scene_ms", set_ms},
      {"first_frame_ms", first_ms},
      {"median_frame_ms", ms[ms.size() / 2]},
      {"fastest_frame_ms", ms.front()}};
  std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

}  // namespace
}  // namespace bihive

int main(int argc, char** argv) {
  return bihive::run(argc, argv);
}
