// Figure 4.2: four spheres at recursion depths 1 to 5, and the depth that each pixel needs.
#include <fmt/format.h>

#include <algorithm>

#include "bihive/image/image_diff.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/views.h"
#include "bihive/scene/generators.h"
#include "pictures.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// The brightness of the pixels whose ray meets a transparent sphere first, and how many of them have a colour.
Json transparent_sphere(const Scene& scene, const Tracer& tracer, const Image& image) {
  std::vector<double> brightness;
  std::int64_t coloured = 0;
  for_each_ray(scene.camera, image.width, image.height, [&](std::size_t pixel, const Ray& ray) {
    const SceneHit hit = scene_hit(scene, tracer, ray);
    if (hit.id < 0 || !(material_of(scene, hit.id).transmissive > 0)) return;
    const std::uint8_t* const rgb = &image.rgb[3 * pixel];
    brightness.push_back((double(rgb[0]) + double(rgb[1]) + double(rgb[2])) / (3 * 255));
    coloured += rgb[0] == rgb[1] && rgb[1] == rgb[2] ? 0 : 1;
  });
  if (brightness.empty()) return {{"pixels", 0}};
  return {{"pixels", brightness.size()},
          {"coloured_pixels", coloured},
          {"brightness_median", median(brightness)},
          {"brightness_mean", mean_and_sd(brightness).mean}};
}

struct Drawing {
  Scene scene = four_spheres_scene();
  Tracer tracer = value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  RenderSettings settings;
  Drawing(const Experiment& experiment, View view, std::int64_t depth)
      : settings(picture_settings(experiment, scene, view)) {
    settings.recursion = static_cast<int>(std::clamp<std::int64_t>(depth, 1, 16));
  }
};

Json draw_depth(const Experiment& experiment, std::int64_t depth) {
  Drawing of(experiment, View::shaded, depth);
  std::int64_t rays = 0;
  const std::optional<Image> image = draw(experiment, of.scene, of.tracer, of.settings, &rays);
  if (!image) return {};
  const double pixels = static_cast<double>(image->rgb.size()) / 3;
  Json result{{"depth", depth},
              {"picture", write_picture(experiment, fmt::format("depth{}.png", depth), *image)},
              {"rays_per_pixel", static_cast<double>(rays) / pixels},
              {"transparent_sphere", transparent_sphere(of.scene, of.tracer, *image)}};

  // The share of the picture that would change with one generation of rays fewer.
  if (of.settings.recursion == 1) return result;
  --of.settings.recursion;
  const std::optional<Image> before = draw(experiment, of.scene, of.tracer, of.settings);
  if (!before) return {};
  result["changed_percent"] = 100 * static_cast<double>(difference_of(*image, *before).pixels) / pixels;
  return result;
}

Json draw_coding(const Experiment& experiment) {
  const Drawing of(experiment, View::recursion, experiment.values.integer("coding.depth"));
  const std::optional<Image> image = draw(experiment, of.scene, of.tracer, of.settings);
  if (!image) return {};

  // Count the pixels of each depth by its colour.
  const double all = static_cast<double>(image->rgb.size()) / 3;
  Json depths = Json::object();
  for (int depth = 0; depth <= of.settings.recursion; ++depth) {
    const Vec3d colour = recursion_colour(depth);
    std::int64_t pixels = 0;
    for (std::size_t i = 0; i < image->rgb.size(); i += 3)
      pixels += Vec3d{image->rgb[i] / 255.0, image->rgb[i + 1] / 255.0, image->rgb[i + 2] / 255.0} == colour;
    const std::string name = fmt::format("depth{}", depth), value = "coding." + name + ".colour";
    depths[name] = {{"depth", depth},
                    {"colour", numbers_of(colour)},
                    {"words", experiment.values.has(value) ? experiment.values.printed(value) : "black"},
                    {"pixels", pixels},
                    {"percent", 100 * static_cast<double>(pixels) / all}};
  }
  std::int64_t transparent = 0;
  for (std::int64_t id = 0; id < of.scene.spheres.size(); ++id)
    transparent += material_of(of.scene, id).transmissive > 0;
  return {{"picture", write_picture(experiment, "depth_colours.png", *image)},
          {"pixels", all},
          {"depths", std::move(depths)},
          {"spheres", of.scene.spheres.size()},
          {"transparent_spheres", transparent}};
}

Json data_of(const Experiment& experiment) {
  Json data = Json::object();
  double before = 0, least_growth = 1e9;
  for (const auto& [name, done] : experiment.finished()) {
    const Json& result = *done;
    if (name == "coding") {
      data["coding"] = result;
      continue;
    }
    data["depths"][name] = result;
    const double rays = result.at("rays_per_pixel");
    if (before > 0) least_growth = std::min(least_growth, rays / before);
    before = rays;
    // The text says "dark gray" of one depth, and we read it as: no pixel is coloured.
    const Json& sphere = result.at("transparent_sphere");
    if (result.at("depth") != experiment.values.integer("dark_grey.depth") || sphere.at("pixels") == 0) continue;
    data["dark_grey"] = {{"radiance", sphere.at("brightness_median")}, {"coloured", sphere.at("coloured_pixels")}};
  }
  if (least_growth < 1e9) data["least_growth_of_rays"] = least_growth;
  return data;
}

}  // namespace

void figure_4_2(Experiment& experiment) {
  for (const std::int64_t depth : experiment.values.integers("depths"))
    experiment.add(fmt::format("depth{}", depth), 0.2, 3, draw_depth, depth);
  experiment.add("coding", 0.1, 1.5, draw_coding);
  experiment.make_data = data_of;
}

}  // namespace bihive::thesis
