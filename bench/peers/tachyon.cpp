#include "peers/tachyon.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "bihive/base/write_file.h"
#include "bihive/math/elementary.h"

namespace bihive::bench {
namespace {

// Tachyon shows a mirrored world: its x runs the other way.
std::string place(Vec3d v) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", -v.x, v.y, v.z);
}

// With ambient occlusion, Tachyon's light from everywhere replaces the ambient term.
std::string texture(const std::string& name, const Material& m, const RenderSettings& settings) {
  return fmt::format(
      "TexDef {} Ambient {} Diffuse {} Specular {} Opacity 1 Phong Plastic {} Phong_size {} Color {} {} {} TexFunc 0\n",
      name, settings.ambient_occlusion ? 0 : m.ambient, m.diffuse, m.reflective, m.specular, m.power, m.colour.x,
      m.colour.y, m.colour.z);
}

// The spheres, with a texture for each colour.
std::string spheres_in_its_language(const Scene& scene, const RenderSettings& settings) {
  std::map<std::array<double, 3>, std::string> textures;
  std::string text;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    const Material material = material_of(scene, id);
    std::string& name = textures[{material.colour.x, material.colour.y, material.colour.z}];
    if (name.empty()) {
      name = fmt::format("ball{}", textures.size());
      text += texture(name, material, settings);
    }
    text += fmt::format("Sphere Center {} Rad {:.9g} {}\n", place(scene.spheres.local_centre(id)),
                        scene.spheres.radius(id), name);
  }
  return text;
}

std::string in_its_language(const Scene& scene, const RenderSettings& settings) {
  // Its zoom is the distance at which a square of side 1 fills the shorter side of the picture.
  const double zoom = 0.5 / tan_deg(scene.camera.fov_deg / 2);
  std::string text = fmt::format(
      "Begin_Scene\nResolution {} {}\nCamera\n  Zoom {:.9g}\n  Aspectratio 1\n  Antialiasing 0\n  Raydepth {}\n  "
      "Center "
      "{}\n  Viewdir {}\n  Updir {}\nEnd_Camera\nBackground {} {} {}\n",
      settings.width_px, settings.height_px, zoom, settings.recursion, place(scene.camera.eye),
      place(scene.camera.look_at - scene.camera.eye), place(scene.camera.up), scene.background.x, scene.background.y,
      scene.background.z);
  for (const PointLight& light : scene.lights)
    text += fmt::format("Light Center {} Rad 0.001 Color {} {} {}\n", place(light.position), light.colour.x,
                        light.colour.y, light.colour.z);
  if (scene.plane) {
    text += texture("ground", scene.plane->material, settings);
    text += fmt::format("Plane Center {} Normal {} ground\n", place(scene.plane->plane.point),
                        place(scene.plane->plane.normal));
  }
  return text + spheres_in_its_language(scene, settings) + "End_Scene\n";
}

// The output of a program; nothing if it does not end with 0.
Result<std::string> output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return Error{"cannot run " + command, "", 0, 0, ""};
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), read);
  if (pclose(pipe) != 0) return Error{"failed: " + command, "", 0, 0, "is Tachyon (Debian package tachyon) there?"};
  return output;
}

}  // namespace

Result<Tachyon> Tachyon::start(const Scene& scene, const RenderSettings& settings, const std::string& path) {
  if (scene.camera.projection != Projection::perspective)
    return Error{"Tachyon is asked for pictures in perspective alone", "", 0, 0, "choose a scene without a projection"};
  if (Result<std::string> version = output_of("command -v tachyon"); !version) return version.error();
  if (const Status status = write_file(path, in_its_language(scene, settings)); !status) return status.error();
  Tachyon tachyon;
  tachyon.command_ = fmt::format("tachyon '{}' -numthreads {} {} -aasamples {} +V", path, settings.threads,
                                 settings.shadows ? "-fullshade -shade_phong" : "-mediumshade -shade_phong",
                                 settings.samples_per_pixel - 1);
  // Its directions are those of the hemisphere in front of the surface.
  if (settings.ambient_occlusion)
    tachyon.command_ += fmt::format(" -add_skylight {} -skylight_samples {}", scene.ambient_light.x,
                                    settings.ambient_occlusion->directions / 2);
  return tachyon;
}

Result<double> Tachyon::render_ms(const std::string& picture) const {
  const std::string to = picture.empty() ? " -nosave" : " -format PNG -o '" + picture + "'";
  const Result<std::string> output = output_of(command_ + to + " 2>&1");
  if (!output) return output.error();
  const std::string label = "Ray Tracing Time:";
  const std::size_t at = output->find(label);
  if (at == std::string::npos) return Error{"Tachyon prints no time", "", 0, 0, ""};
  return 1000 * std::strtod(output->c_str() + at + label.size(), nullptr);
}

}  // namespace bihive::bench
