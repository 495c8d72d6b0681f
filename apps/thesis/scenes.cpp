// Figure 4.1: the three scenarios, and whether the scenes are as the text says.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "pictures.h"

namespace bihive::thesis {
namespace {

constexpr int kQuickDivisor = 4;
// Each sphere of the regular grid shares its x with at least this many others; random spheres hardly ever share it with
// one.
constexpr int kRegular = 8;
// The error of a grid's last sphere after adding up steps in binary32, at most.
constexpr double kRounding = 4e-4;

// The number of spheres that lie wholly inside the four sides of the picture.
std::int64_t spheres_in_view(const Scene& scene, cli::PictureSize size) {
  const PixelRays rays(scene.camera, size.width_px, size.height_px);
  const auto direction = [&](int x, int y) { return to_double(rays.at(x, y).direction); };
  const std::array<Vec3d, 4> corners{direction(0, 0), direction(size.width_px, 0),
                                     direction(size.width_px, size.height_px), direction(0, size.height_px)};
  std::int64_t inside = 0;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    bool wholly = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3d inward = normalized(cross(corners[i], corners[(i + 1) % 4]));
      wholly = wholly && dot(scene.spheres.centre(id) - scene.camera.eye, inward) >= scene.spheres.radius(id);
    }
    inside += wholly ? 1 : 0;
  }
  return inside;
}

// The least angle along the picture's shorter side, in degrees, with which every sphere is wholly in view. The camera
// looks along -z.
double needed_fov_deg(const Scene& scene) {
  double most = 0;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    const Vec3d to = scene.spheres.centre(id) - scene.camera.eye;
    const double distance = std::hypot(to.y, to.z);
    most = std::max(most, std::atan2(std::abs(to.y), -to.z) + std::asin(scene.spheres.radius(id) / distance));
  }
  return 2 * most * 180 / 3.14159265358979323846;
}

using Ids = std::vector<std::int64_t>;

// The number of the cube's corners with some of these spheres wholly inside a small cube; 0 if any lies elsewhere.
int occupied_corners(const SphereSet& spheres, const Ids& ids, const Values& values) {
  const std::vector<double> cube = values.numbers("cube");
  const double low = cube.front(), high = cube.back(), side = values.number("scenario2.cluster_side");
  std::set<int> corners;
  for (const std::int64_t id : ids) {
    const Vec3d centre = spheres.centre(id);
    const double radius = spheres.radius(id);
    int corner = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = centre[axis] > 0.5 * (low + high);
      corner |= upper ? 1 << axis : 0;
      const double lo = upper ? high - side : low, hi = upper ? high : low + side;
      if (centre[axis] - radius < lo - kRounding || centre[axis] + radius > hi + kRounding) return 0;
    }
    corners.insert(corner);
  }
  return static_cast<int>(corners.size());
}

// The largest difference of two distances between neighbouring rows of spheres, over width, height and depth.
double spacing_difference(const SphereSet& spheres, const Ids& ids) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::set<double> rows;
    for (const std::int64_t id : ids) rows.insert(spheres.centre(id)[axis]);
    for (auto row = rows.begin(); row != rows.end() && std::next(row) != rows.end(); ++row) {
      least = std::min(least, *std::next(row) - *row);
      most = std::max(most, *std::next(row) - *row);
    }
  }
  return most - least;
}

// Those that stand in rows, and the others.
struct Halves {
  Ids rows, clustered;
};
Halves halves_of(const SphereSet& spheres, const Ids& all) {
  std::map<float, int> rows;
  for (const float x : spheres.x()) ++rows[x];
  Halves halves;
  for (const std::int64_t id : all)
    (rows[spheres.x()[static_cast<std::size_t>(id)]] < kRegular ? halves.clustered : halves.rows).push_back(id);
  return halves;
}

Json material_facts(const Material& material) {
  return {{"colour", numbers_of(material.colour)}, {"ambient", material.ambient},
          {"diffuse", material.diffuse},           {"reflective", material.reflective},
          {"specular", material.specular},         {"power", material.power},
          {"transmissive", material.transmissive}, {"refraction_index", material.refraction_index}};
}

Json scene_facts(const Scene& scene) {
  return {
      {"camera", {{"eye", numbers_of(scene.camera.eye)}, {"needed_fov_deg", needed_fov_deg(scene)}}},
      {"lights", scene.lights.size()},
      {"light",
       {{"position", numbers_of(scene.lights.at(0).position)}, {"colour", numbers_of(scene.lights.at(0).colour)}}},
      {"plane", {{"point", numbers_of(scene.plane->plane.point)}, {"normal", numbers_of(scene.plane->plane.normal)}}},
      {"red", material_facts(material_of(scene, 0))},
      {"transparent", material_facts(material_of(scene, 1))}};
}

Json draw_scenario(const StepContext& context, std::int64_t number) {
  // Make the scene, and draw it.
  const Values& values = context.values;
  const Scene scene = values.scene(number, values.integer("spheres"), context.settings.seed);
  const Tracer tracer = cli::value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  const cli::PictureSize size = picture_size(context.settings, values, kQuickDivisor);
  RenderSettings settings = picture_settings(context, scene, size, View::shaded);
  settings.recursion = static_cast<int>(std::clamp<std::int64_t>(values.integer("recursion"), 1, 16));
  const std::optional<Image> image = draw(context, scene, tracer, settings);
  if (!image) return {};

  // What the text says of its spheres.
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  Ids all(static_cast<std::size_t>(scene.spheres.size()));
  std::iota(all.begin(), all.end(), 0);
  const Halves halves = halves_of(scene.spheres, all);
  return {{"number", number},
          {"picture", write_picture(context, fmt::format("scenario{}.png", number), *image)},
          {"spheres", scene.spheres.size()},
          {"in_view", spheres_in_view(scene, size)},
          {"extent",
           {std::min({bounds.lo.x, bounds.lo.y, bounds.lo.z}), std::max({bounds.hi.x, bounds.hi.y, bounds.hi.z})}},
          {"coinciding", coinciding_spheres(scene.spheres)},
          {"spacing_difference", spacing_difference(scene.spheres, all)},
          {"corners", occupied_corners(scene.spheres, all, values)},
          {"clustered_share", static_cast<double>(halves.clustered.size()) / static_cast<double>(all.size())},
          {"clustered_corners", occupied_corners(scene.spheres, halves.clustered, values)},
          {"rows_spacing_difference", spacing_difference(scene.spheres, halves.rows)},
          {"scene", scene_facts(scene)}};
}

std::string step_name(std::int64_t scenario) {
  return fmt::format("scenario{}", scenario);
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  std::vector<Step> steps;
  for (const std::int64_t number : values.integers("scenarios"))
    steps.push_back({step_name(number), settings.quick ? 0.5 : 3.0,
                     [number](StepContext& context) { return draw_scenario(context, number); }});
  return steps;
}

Json data_of(const DataContext& context) {
  Json data = Json::object();
  for (const std::int64_t number : context.values.integers("scenarios"))
    if (const Json* const result = context.result(step_name(number))) {
      data["scene"] = result->at("scene");
      Json& scenario = data["scenarios"][step_name(number)] = *result;
      scenario.erase("scene");
    }
  return data;
}

}  // namespace

std::int64_t coinciding_spheres(const SphereSet& spheres) {
  std::set<std::array<double, 3>> places;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d centre = spheres.centre(id);
    places.insert({centre.x, centre.y, centre.z});
  }
  return spheres.size() - static_cast<std::int64_t>(places.size());
}

ExperimentCode figure_4_1() {
  return {steps_of, data_of};
}

}  // namespace bihive::thesis
