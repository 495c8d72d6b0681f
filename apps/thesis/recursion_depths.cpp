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

constexpr int kQuickDivisor = 4;
constexpr const char* kCodingStep = "coding";

std::string step_name(std::int64_t depth) {
  return fmt::format("depth{}", depth);
}

struct Pixel {
  std::uint8_t r, g, b;
  double brightness() const { return (double(r) + double(g) + double(b)) / (3 * 255); }
  bool grey() const { return r == g && g == b; }
};
Pixel pixel_at(const Image& image, std::size_t i) {
  return {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]};
}

// The brightness of the pixels whose ray meets a transparent sphere first, and how many of them have a colour.
Json transparent_sphere(const Scene& scene, const Tracer& tracer, const Image& image) {
  const PixelRays rays(scene.camera, image.width, image.height);
  std::vector<double> brightness;
  std::int64_t coloured = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const SceneHit hit = scene_hit(scene, tracer, rays.at(x + 0.5, y + 0.5));
      if (hit.id < 0 || !(material_of(scene, hit.id).transmissive > 0)) continue;
      const Pixel pixel = pixel_at(
          image, static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
      brightness.push_back(pixel.brightness());
      coloured += pixel.grey() ? 0 : 1;
    }
  if (brightness.empty()) return {{"pixels", 0}};
  return {{"pixels", brightness.size()},
          {"coloured_pixels", coloured},
          {"brightness_median", median(brightness)},
          {"brightness_mean", spread_of(brightness).mean}};
}

Json draw_depth(const StepContext& context, std::int64_t depth) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = cli::value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  RenderSettings settings =
      picture_settings(context, scene, picture_size(context.settings, context.values, kQuickDivisor), View::shaded);
  settings.recursion = static_cast<int>(std::clamp<std::int64_t>(depth, 1, 16));
  std::int64_t rays = 0;
  const std::optional<Image> image = draw(context, scene, tracer, settings, &rays);
  if (!image) return {};
  const double pixels = static_cast<double>(image->rgb.size()) / 3;
  Json result{{"depth", depth},
              {"picture", write_picture(context, step_name(depth) + ".png", *image)},
              {"rays_per_pixel", static_cast<double>(rays) / pixels},
              {"transparent_sphere", transparent_sphere(scene, tracer, *image)}};

  // The share of the picture that would change with one generation of rays less.
  if (settings.recursion == 1) return result;
  --settings.recursion;
  const std::optional<Image> before = draw(context, scene, tracer, settings);
  if (!before) return {};
  result["changed_percent"] = 100 * static_cast<double>(difference_of(*image, *before).pixels) / pixels;
  return result;
}

Json draw_coding(const StepContext& context) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = cli::value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  RenderSettings settings =
      picture_settings(context, scene, picture_size(context.settings, context.values, kQuickDivisor), View::recursion);
  settings.recursion = static_cast<int>(std::clamp<std::int64_t>(context.values.integer("coding.depth"), 1, 16));
  const std::optional<Image> image = draw(context, scene, tracer, settings);
  if (!image) return {};

  // Count the pixels of each depth by its colour.
  const double all = static_cast<double>(image->rgb.size()) / 3;
  Json depths = Json::object();
  for (int depth = 0; depth <= settings.recursion; ++depth) {
    const Vec3d colour = recursion_colour(depth);
    std::int64_t pixels = 0;
    for (std::size_t i = 0; i < image->rgb.size() / 3; ++i) {
      const Pixel pixel = pixel_at(*image, i);
      if (Vec3d{pixel.r / 255.0, pixel.g / 255.0, pixel.b / 255.0} == colour) ++pixels;
    }
    const std::string name = fmt::format("coding.depth{}.colour", depth);
    depths[step_name(depth)] = {{"depth", depth},
                                {"colour", numbers_of(colour)},
                                {"words", context.values.has(name) ? context.values.printed(name) : "black"},
                                {"pixels", pixels},
                                {"percent", 100 * static_cast<double>(pixels) / all}};
  }
  std::int64_t transparent = 0;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id)
    if (material_of(scene, id).transmissive > 0) ++transparent;
  return {{"picture", write_picture(context, "depth_colours.png", *image)},
          {"pixels", all},
          {"depths", std::move(depths)},
          {"spheres", scene.spheres.size()},
          {"transparent_spheres", transparent}};
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  const double weight = settings.quick ? 0.1 : 1.5;
  std::vector<Step> steps;
  for (const std::int64_t depth : values.integers("depths"))
    steps.push_back(
        {step_name(depth), 2 * weight, [depth](StepContext& context) { return draw_depth(context, depth); }});
  steps.push_back({kCodingStep, weight, [](StepContext& context) { return draw_coding(context); }});
  return steps;
}

Json data_of(const DataContext& context) {
  Json data = Json::object();
  double before = 0, least_growth = 1e9;
  for (const std::int64_t depth : context.values.integers("depths"))
    if (const Json* const result = context.result(step_name(depth))) {
      data["depths"][step_name(depth)] = *result;
      const double rays = result->at("rays_per_pixel").get<double>();
      if (before > 0) least_growth = std::min(least_growth, rays / before);
      before = rays;
      // The text says "dark gray" of one depth, and we read it as: no pixel is coloured.
      const Json& sphere = result->at("transparent_sphere");
      if (depth != context.values.integer("dark_grey.depth") || sphere.at("pixels") == 0) continue;
      data["dark_grey"] = {{"radiance", sphere.at("brightness_median")}, {"coloured", sphere.at("coloured_pixels")}};
    }
  if (least_growth < 1e9) data["least_growth_of_rays"] = least_growth;
  if (const Json* const coding = context.result(kCodingStep)) data["coding"] = *coding;
  return data;
}

}  // namespace

ExperimentCode figure_4_2() {
  return {steps_of, data_of};
}

}  // namespace bihive::thesis
