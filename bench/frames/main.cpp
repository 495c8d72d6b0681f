// bihive-frames: times of whole pictures, for docs/performance.md. Prints one JSON object.
//   bihive-frames pictures THREADS REPETITIONS FOLDER   s1 s2 s3 at 1024 x 1024, depth 5, shadows; Tachyon in turn
//   bihive-frames occlusion THREADS REPETITIONS FOLDER FILE
//                                                       ambient occlusion: the molecule, a million spheres; Tachyon in
//                                                       turn
//   bihive-frames film THREADS REPETITIONS FOLDER FILE  a frame of a film, in the styles default and plain; Tachyon in
//                                                       turn
//   bihive-frames thesis THREADS REPETITIONS            the thesis's nine configurations of Figure 4.4
//   bihive-frames rebuild THREADS REPETITIONS           spheres that move: a new tree for every frame
#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bihive/base/timer.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/image/png.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/math/quartiles.h"
#include "bihive/math/rng.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/style.h"
#include "bihive/simd/target.h"
#include "bihive/wide/wide_builder.h"
#include "frames/frame.h"
#include "peers/tachyon.h"
#include "synthetic.h"

namespace bihive::bench {
namespace {

using nlohmann::ordered_json;

struct Request {
  int threads, repetitions;
  std::string folder, input;
};

ordered_json described(const Request& request) {
  return {{"threads", request.threads},
          {"repetitions", request.repetitions},
          {"target", active_target()},
          {"commit", commit()}};
}

ordered_json counts(const RenderCounts& rays) {
  return {{"primary", rays.primary}, {"shadow", rays.shadow}, {"reflected", rays.reflected}, {"ambient", rays.ambient}};
}

// One picture, in turn with Tachyon's. Both first draw one that does not count; both pictures stay in the folder.
ordered_json beside_tachyon(const Scene& scene, const RenderSettings& settings, const std::string& name,
                            const Request& request) {
  const std::string file = request.folder + "/" + name;
  const Tachyon tachyon = value_or_fail(Tachyon::start(scene, settings, file + ".dat"));
  value_or_fail(tachyon.render_ms(file + "_tachyon.png"));
  const Tracer tracer = Tracer::build(scene.spheres, Engine::automatic).value();
  FrameTimes ours, warm;
  std::vector<double> theirs;
  add_frame(scene, tracer, settings, warm);
  for (int i = 0; i < request.repetitions; ++i) {
    add_frame(scene, tracer, settings, ours);
    theirs.push_back(value_or_fail(tachyon.render_ms()));
  }
  const Image image =
      image_from_film(render(scene, tracer, settings).value().film, settings.view, scene.picture.transfer);
  const std::string png = value_or_fail(encode_png(image, {}));
  if (const Status status = write_file(file + "_bihive.png", png); !status) fail(status.error());
  return {{"spheres", scene.spheres.size()},        {"rays", counts(ours.rays)}, {"build_ms", tracer.build_ms()},
          {"render_ms", ours.render_ms()},          {"all_ms", ours.all_ms()},   {"tachyon_ms", median(theirs)},
          {"ratio", median(theirs) / ours.all_ms()}};
}

ordered_json pictures(const Request& request) {
  ordered_json json = described(request);
  for (const char* name : {"s1", "s2", "s3"})
    json["scenes"][name] = beside_tachyon(*synthetic_scene(name), whole_picture(request.threads), name, request);
  return json;
}

// The scene of a file in a style, as bihive gives it to any file.
LoadedScene file_in_style(const std::string& path, const Style& style) {
  const std::string bytes = value_or_fail(read_file(path));
  return value_or_fail(load_scene(bytes, path, ReadOptions{}, LooksOfFile::apply, &style));
}

// The settings of a picture of the scene, which first gets a camera, and the style's lights around it.
RenderSettings settings_before(const Style& style, int threads, Scene& scene) {
  RenderSettings settings = settings_from(scene.picture);
  settings.threads = threads;
  scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, settings.width_px, settings.height_px);
  scene.lights = lights_around(style.lights, scene.camera);
  return settings;
}

// Pictures in the default style. Of the 128 directions some 64 are in front of a shading point, as many as Tachyon is
// told to use. Neither limits the distance. Tachyon casts hard shadows, and draws neither outlines nor fog.
ordered_json occlusion(const Request& request) {
  const Style style = style_named(style_names().front()).value();
  LoadedScene molecule = file_in_style(request.input, style);
  Scene million = *synthetic_scene("u1e6");
  million.plane.reset();
  apply_style(style, million);

  ordered_json json = described(request);
  for (const auto& [name, scene] : {std::pair<std::string, Scene*>{"1tii", &molecule.scene}, {"u1e6", &million}}) {
    RenderSettings settings = settings_before(style, request.threads, *scene);
    settings.ambient_occlusion = AmbientOcclusion{};
    settings.ambient_occlusion->directions = 128;
    json["scenes"][name] = beside_tachyon(*scene, settings, name, request);
  }
  return json;
}

// A frame of a film in two styles. Tachyon gets as many directions of ambient occlusion as bihive has before a surface.
ordered_json film(const Request& request) {
  ordered_json json = described(request);
  for (const char* name : {"default", "plain"}) {
    const Style style = style_named(name).value();
    LoadedScene frame = file_in_style(request.input, style);
    const RenderSettings settings = settings_before(style, request.threads, frame.scene);
    json["styles"][name] = beside_tachyon(frame.scene, settings, fmt::format("frame_{}", name), request);
  }
  return json;
}

ordered_json thesis(const Request& request) {
  ordered_json json = described(request);
  for (const int scenario : {1, 2, 3})
    for (const int count : {64, 128, 256}) {
      ScenarioParameters parameters;
      parameters.count = count;
      const Scene scene = scenario_scene(static_cast<Scenario>(scenario), parameters).value();
      const Tracer tracer = Tracer::build(scene.spheres, Engine::automatic).value();
      FrameTimes times, warm;
      for (int i = 0; i < 5; ++i) add_frame(scene, tracer, thesis_frame(request.threads), warm);
      for (int i = 0; i < request.repetitions; ++i) add_frame(scene, tracer, thesis_frame(request.threads), times);
      json["configurations"].push_back({{"scenario", scenario},
                                        {"spheres", count},
                                        {"render_ms", times.render_ms()},
                                        {"fps", 1000 / times.render_ms()},
                                        {"fps_with_bytes", 1000 / times.all_ms()}});
    }
  return json;
}

// Every sphere moves by its own small step in each frame; the builder reuses the memory of the previous tree.
ordered_json rebuild(const Request& request) {
  ordered_json json = described(request);
  for (const char* name : {"s1", "u1e5", "u1e6"}) {
    const SphereSet start = synthetic_scene(name)->spheres;
    std::vector<float> x(static_cast<std::size_t>(start.size())), y(x), z(x), r(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3f centre = to_float(start.centre(static_cast<std::int64_t>(i)));
      x[i] = centre.x;
      y[i] = centre.y;
      z[i] = centre.z;
      r[i] = static_cast<float>(start.radius(static_cast<std::int64_t>(i)));
    }
    SplitMix64 random(1);
    WideBuilder builder;
    std::vector<double> set_ms, build_ms;
    double first_ms = 0;
    std::int64_t held_bytes = 0;
    for (int frame = 0; frame <= request.repetitions; ++frame) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += 0.1F * (random.next_float() - 0.5F) * r[i];
        y[i] += 0.1F * (random.next_float() - 0.5F) * r[i];
        z[i] += 0.1F * (random.next_float() - 0.5F) * r[i];
      }
      const Timer set_timer;
      const SphereSet moved = SphereSet::from_world(x, y, z, r).value();
      const double ms = set_timer.elapsed_ms();
      const Timer build_timer;
      const auto tree = value_or_fail(builder.build(moved, {}, request.threads));
      if (frame == 0) {
        first_ms = build_timer.elapsed_ms();
        continue;
      }
      set_ms.push_back(ms);
      build_ms.push_back(build_timer.elapsed_ms());
      held_bytes = tree->allocated_bytes() + builder.scratch_bytes();
    }
    json["scenes"][name] = {{"spheres", start.size()},  {"first_build_ms", first_ms},
                            {"set_ms", median(set_ms)}, {"build_ms", median(build_ms)},
                            {"held_bytes", held_bytes}, {"builds_per_s", 1000 / median(build_ms)}};
  }
  return json;
}

int run(int argc, const char* const* argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const Request request{argc > 2 ? std::atoi(argv[2]) : 0, argc > 3 ? std::atoi(argv[3]) : 0, argc > 4 ? argv[4] : "",
                        argc > 5 ? argv[5] : ""};
  const bool known = (what == "pictures" && argc == 5) || ((what == "occlusion" || what == "film") && argc == 6) ||
                     ((what == "thesis" || what == "rebuild") && argc == 4);
  if (!known || request.threads < 1 || request.repetitions < 1) {
    say_error(
        "usage: bihive-frames pictures THREADS REPETITIONS FOLDER | occlusion|film THREADS REPETITIONS FOLDER FILE | "
        "thesis|rebuild THREADS REPETITIONS");
    return kBadUsage;
  }
  try {
    const ordered_json json = what == "pictures"    ? pictures(request)
                              : what == "occlusion" ? occlusion(request)
                              : what == "film"      ? film(request)
                              : what == "thesis"    ? thesis(request)
                                                    : rebuild(request);
    print(json.dump(2) + "\n");
    finish_output();
    return kSuccess;
  } catch (const Failure& failure) {
    say_error(failure.error.to_string());
    return failure.code;
  }
}

}  // namespace
}  // namespace bihive::bench

int main(int argc, char** argv) {
  return bihive::bench::run(argc, argv);
}
