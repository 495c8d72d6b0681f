// Figure 4.1: the three scenarios, compared with the text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "bihive/base/json_text.h"
#include "bihive/scene/scene_file.h"
#include "pictures.h"

namespace bihive::thesis {
namespace {

// Each sphere of the regular grid shares its x with at least this many others; random spheres hardly ever share it with
// one.
constexpr int kRegular = 8;
// The error of a grid's last sphere after adding up steps in binary32, at most.
constexpr double kRounding = 4e-4;

// The angle between the camera's axis and the far side of a sphere, along x or y, in radians. The camera looks along
// -z.
double angle_of(const Scene& scene, std::int64_t id, int axis) {
  const Vec3d to = scene.spheres.centre(id) - scene.camera.eye;
  return std::atan2(std::abs(to[axis]), -to.z) + std::asin(scene.spheres.radius(id) / std::hypot(to[axis], to.z));
}

// The number of spheres that lie wholly inside the four sides of the picture.
std::int64_t spheres_in_view(const Scene& scene, const RenderSettings& picture) {
  const Vec3d corner = to_double(PixelRays(scene.camera, picture.width_px, picture.height_px).at(0, 0).direction);
  std::int64_t inside = 0;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id)
    inside += angle_of(scene, id, 0) <= std::atan2(std::abs(corner.x), -corner.z) &&
              angle_of(scene, id, 1) <= std::atan2(std::abs(corner.y), -corner.z);
  return inside;
}

// The least angle along the picture's shorter side, in degrees, with which every sphere is wholly in view.
double needed_fov_deg(const Scene& scene) {
  double most = 0;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) most = std::max(most, angle_of(scene, id, 1));
  return 2 * most * 180 / 3.14159265358979323846;
}

using Ids = std::vector<std::int64_t>;

// The number of the cube's corners with some of these spheres wholly inside a small cube; 0 if any lies outside them.
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

// The scene as a scene file has it, without its spheres; and what follows from it.
Json scene_facts(const Scene& scene) {
  Json facts = value_or_fail(json_from_text<Json>(scene_to_json(scene)));
  facts.erase("spheres");
  facts["light_count"] = scene.lights.size();
  facts["camera"]["needed_fov_deg"] = needed_fov_deg(scene);
  return facts;
}

Json draw_scenario(const Experiment& experiment, std::int64_t number) {
  // Make the scene, and draw it.
  const Values& values = experiment.values;
  const Scene scene = values.scene(number, values.integer("spheres"), experiment.settings.seed);
  const SphereSet& spheres = scene.spheres;
  const Tracer tracer = value_or_fail(Tracer::build(spheres, Engine::automatic));
  RenderSettings settings = picture_settings(experiment, scene, View::shaded);
  settings.recursion = static_cast<int>(std::clamp<std::int64_t>(values.integer("recursion"), 1, 16));
  const std::optional<Image> image = draw(experiment, scene, tracer, settings);
  if (!image) return {};

  // The text describes three sets: all spheres, those in rows, and the others.
  Ids all(static_cast<std::size_t>(spheres.size())), in_rows, clustered;
  std::iota(all.begin(), all.end(), 0);
  std::map<float, int> rows;
  for (const float x : spheres.x()) ++rows[x];
  for (const std::int64_t id : all)
    (rows[spheres.x()[static_cast<std::size_t>(id)]] < kRegular ? clustered : in_rows).push_back(id);
  const SphereSet::Bounds bounds = spheres.bounds();
  return {{"number", number},
          {"picture", write_picture(experiment, fmt::format("scenario{}.png", number), *image)},
          {"spheres", spheres.size()},
          {"in_view", spheres_in_view(scene, settings)},
          {"extent",
           {std::min({bounds.lo.x, bounds.lo.y, bounds.lo.z}), std::max({bounds.hi.x, bounds.hi.y, bounds.hi.z})}},
          {"coinciding", coinciding_spheres(spheres)},
          {"spacing_difference", spacing_difference(spheres, all)},
          {"corners", occupied_corners(spheres, all, values)},
          {"clustered_share", static_cast<double>(clustered.size()) / static_cast<double>(all.size())},
          {"clustered_corners", occupied_corners(spheres, clustered, values)},
          {"rows_spacing_difference", spacing_difference(spheres, in_rows)},
          {"scene", scene_facts(scene)}};
}

}  // namespace

void figure_4_1(Experiment& experiment) {
  for (const std::int64_t number : experiment.values.integers("scenarios"))
    experiment.add(fmt::format("scenario{}", number), 0.5, 3, draw_scenario, number);
  experiment.make_data = [](const Experiment& drawn) {
    Json data = Json::object();
    for (const auto& [name, result] : drawn.finished()) {
      data["scene"] = result->at("scene");
      data["scenarios"][name] = *result;
      data["scenarios"][name].erase("scene");
    }
    return data;
  };
}

}  // namespace bihive::thesis
