// Figure 4.1: the three scenarios, and whether the scenes agree with the text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "thesis/coinciding.h"
#include "thesis/compare.h"
#include "thesis/pictures.h"

namespace bihive::cli::thesis {
namespace {

const std::string kId = "figure-4.1";
constexpr int kQuickDivisor = 4;

// Each sphere of the regular grid shares its x with at least this many others; random spheres hardly ever share it with
// one.
constexpr int kRegular = 8;
// The error of a grid's last sphere after adding up steps in binary32, at most, as a share of the cube's side.
constexpr double kRounding = 1e-5;

std::string step_name(double scenario) {
  return fmt::format("scenario{}", scenario);
}

// The number of spheres that lie wholly inside the four sides of the picture.
std::int64_t spheres_in_view(const Scene& scene, PictureSize size) {
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

using Ids = std::vector<std::int64_t>;

Ids all_ids(const SphereSet& spheres) {
  Ids ids(static_cast<std::size_t>(spheres.size()));
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

// The number of the cube's corners with some of these spheres wholly inside a small cube; 0 if any lies elsewhere.
int occupied_corners(const SphereSet& spheres, const Ids& ids, const Values& values) {
  const double low = values.number("cube.low"), high = values.number("cube.high");
  const double side = values.number("scenario2.cluster_side"), rounding = kRounding * (high - low);
  std::set<int> corners;
  for (const std::int64_t id : ids) {
    const Vec3d centre = spheres.centre(id);
    const double radius = spheres.radius(id);
    int corner = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = centre[axis] > 0.5 * (low + high);
      corner |= upper ? 1 << axis : 0;
      const double lo = upper ? high - side : low, hi = upper ? high : low + side;
      if (centre[axis] - radius < lo - rounding || centre[axis] + radius > hi + rounding) return 0;
    }
    corners.insert(corner);
  }
  return static_cast<int>(corners.size());
}

// The least and the largest distance between neighbouring rows of spheres, over width, height and depth.
std::pair<double, double> spacing(const SphereSet& spheres, const Ids& ids) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::set<double> rows;
    for (const std::int64_t id : ids) rows.insert(spheres.centre(id)[axis]);
    for (auto row = rows.begin(); row != rows.end() && std::next(row) != rows.end(); ++row) {
      least = std::min(least, *std::next(row) - *row);
      most = std::max(most, *std::next(row) - *row);
    }
  }
  return {least, most};
}

// Those that stand in rows, and the others.
struct Halves {
  Ids rows, clustered;
};
Halves halves_of(const SphereSet& spheres) {
  std::map<float, int> rows;
  for (const float x : spheres.x()) ++rows[x];
  Halves halves;
  for (const std::int64_t id : all_ids(spheres))
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
      {"camera", {{"eye", numbers_of(scene.camera.eye)}}},
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
  ScenarioParameters parameters;
  parameters.count = values.integer("spheres");
  parameters.radius = static_cast<float>(values.number("radius"));
  parameters.seed = context.settings.seed;
  const Scene scene = value_or_fail(scenario_scene(scenario_of(number), parameters));
  const Tracer tracer = value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  const PictureSize size = picture_size(context.settings, values, kQuickDivisor);
  RenderSettings settings = picture_settings(context, scene, size, View::shaded);
  settings.recursion = static_cast<int>(std::clamp<std::int64_t>(values.integer("recursion"), 1, 16));
  const std::optional<Image> image = draw(context, scene, tracer, settings);
  if (!image) return {};

  // Store the values that the text states.
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  Json result{{"picture", write_picture(context, step_name(double(number)) + ".png", *image)},
              {"spheres", scene.spheres.size()},
              {"spheres_in_view", spheres_in_view(scene, size)},
              {"low", std::min({bounds.lo.x, bounds.lo.y, bounds.lo.z})},
              {"high", std::max({bounds.hi.x, bounds.hi.y, bounds.hi.z})},
              {"coinciding", coinciding_spheres(scene.spheres)},
              {"scene", scene_facts(scene)}};
  const Ids all = all_ids(scene.spheres);
  const auto range = [&](const Ids& ids) {
    const auto [least, most] = spacing(scene.spheres, ids);
    return Json{least, most};
  };
  result["spacing"] = range(all);
  const int corners = occupied_corners(scene.spheres, all, values);
  result["clusters"] = corners;
  const Halves halves = halves_of(scene.spheres);
  result["clustered_share"] = static_cast<double>(halves.clustered.size()) / static_cast<double>(all.size());
  const int clustered_corners = occupied_corners(scene.spheres, halves.clustered, values);
  result["clustered_corners"] = clustered_corners;
  if (!halves.rows.empty()) result["rows_spacing"] = range(halves.rows);
  return result;
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  std::vector<Step> steps;
  for (const double number : values.numbers("scenarios"))
    steps.push_back({step_name(number), settings.quick ? 0.5 : 3.0, [number](StepContext& context) {
                       return draw_scenario(context, static_cast<std::int64_t>(number));
                     }});
  return steps;
}

// Each stated value of the scene must be equal, digit by digit.
void add_scene(Statements& statements, const Values& values, const Json& facts) {
  const auto add = [&](const std::string& name, const std::string& statement, const Json& ours) {
    if (!values.has(name)) return;
    const std::vector<double> found =
        ours.is_array() ? ours.get<std::vector<double>>() : std::vector<double>{ours.get<double>()};
    const std::string text = found.size() > 1 ? vector_text(found) : fmt::format("{}", found[0]);
    const std::string thesis = found.size() > 1 && values.printed(name).front() == '['
                                   ? vector_text(values.numbers(name))
                                   : values.printed(name);
    statements.add(name, statement, {thesis, values.kind(name)}, text, verdict_if(values.numbers(name) == found));
  };
  add("camera.eye", "Camera", facts.at("camera").at("eye"));
  add("lights", "Lights", facts.at("lights"));
  add("light.position", "Light", facts.at("light").at("position"));
  add("light.colour", "Light's colour", facts.at("light").at("colour"));
  add("plane.point", "Plane through", facts.at("plane").at("point"));
  add("plane.normal", "Plane's normal", facts.at("plane").at("normal"));
  for (const std::string material : {"red", "transparent"})
    for (const auto& [property, ours] : facts.at(material).items()) {
      std::string words = property;
      std::replace(words.begin(), words.end(), '_', ' ');
      add(material + "." + property, material + ": " + words, ours);
    }
}

// The text's statements about the places of the spheres.
void add_places(Statements& statements, const Values& values, std::int64_t number, const Json& result) {
  const double low = values.number("cube.low"), high = values.number("cube.high"), rounding = kRounding * (high - low);
  const double ours_low = result.at("low").get<double>(), ours_high = result.at("high").get<double>();
  const std::string name = step_name(double(number)), scenario = fmt::format("Scenario {}: ", number);
  statements.add(name + ".cube", scenario + "the spheres fill a cube",
                 fmt::format("[{}, {}]", values.printed("cube.low"), values.printed("cube.high")),
                 fmt::format("[{:.3f}, {:.3f}]", ours_low, ours_high),
                 verdict_if(ours_low >= low - rounding && ours_high <= high + rounding &&
                            (number != 1 || (ours_low <= low + rounding && ours_high >= high - rounding))));
  const auto count = result.at("spheres").get<std::int64_t>(), seen = result.at("spheres_in_view").get<std::int64_t>();
  statements.add(name + ".visible", scenario + "all primitives are visible", "all",
                 fmt::format("{} of {}", seen, count), verdict_if(seen == count));
  if (number == 1 && values.has("scenario1.spacing_difference")) {
    const double least = result.at("spacing").at(0).get<double>(), most = result.at("spacing").at(1).get<double>();
    statements.add("scenario1.spacing", scenario + "spacing across width, height and depth",
                   {values, "scenario1.spacing_difference"}, fmt::format("{:.4f} to {:.4f}", least, most),
                   verdict_if(std::abs(most - least - values.number("scenario1.spacing_difference")) <= rounding));
  }
  if (number == 2) {
    const auto clusters = result.at("clusters").get<std::int64_t>();
    statements.add("scenario2.clusters", scenario + "smaller cubes in the corners, with all spheres",
                   {values, "scenario2.clusters"}, fmt::format("{}", clusters),
                   verdict_if(clusters == values.integer("scenario2.clusters")));
  }
  if (number == 3) {
    // Rounded down if the number of spheres is odd.
    const double share = result.at("clustered_share").get<double>();
    const double most = values.number("scenario3.clustered_share") * double(count);
    const auto corners = result.at("clustered_corners").get<std::int64_t>();
    statements.add(
        "scenario3.clustered_share", scenario + "share of the spheres that are clustered in the corners",
        {values, "scenario3.clustered_share"},
        fmt::format("{:.4g}, {}", share,
                    corners > 0 ? fmt::format("all in small cubes in {} corners", corners)
                                : "not all in small cubes in the corners"),
        verdict_if(std::floor(most) == share * double(count) && corners == values.integer("scenario2.clusters")));
    if (result.contains("rows_spacing") && values.has("scenario3.spacing_difference")) {
      const double least_step = result.at("rows_spacing").at(0).get<double>(),
                   most_step = result.at("rows_spacing").at(1).get<double>();
      statements.add(
          "scenario3.spacing", scenario + "spacing of the other half across the cube",
          {values, "scenario3.spacing_difference"}, fmt::format("{:.4f} to {:.4f}", least_step, most_step),
          verdict_if(std::abs(most_step - least_step - values.number("scenario3.spacing_difference")) <= rounding));
    }
  }
}

// "Scenario 1: 0, Scenario 2: 0, Scenario 3: 320": spheres at the place of another.
std::string coinciding_text(const Json& scenarios) {
  std::vector<std::string> counts;
  for (const auto& [name, result] : scenarios.items())
    counts.push_back(fmt::format("Scenario {}: {}", name.substr(step_name(0).size() - 1), result["coinciding"].dump()));
  return fmt::format("{}", fmt::join(counts, ", "));
}

Section section_of(const SectionContext& context) {
  Section section;
  Statements statements("What the text says of the scenes",
                        "A number agrees if it is the same. The spheres' cube agrees if all lie inside it up to "
                        "rounding, and if in Scenario 1 they reach its faces.");
  Json scenarios = Json::object();
  for (const double number : context.values.numbers("scenarios")) {
    const auto found = context.results.find(step_name(number));
    if (found == context.results.end()) continue;
    const Json& result = found->second;
    if (statements.empty()) add_scene(statements, context.values, result.at("scene"));
    add_places(statements, context.values, static_cast<std::int64_t>(number), result);
    section.illustrations.push_back(illustration_of(
        kId, result.at("picture"), fmt::format("Scenario {}: {} spheres", number, result.at("spheres").dump())));
    scenarios[step_name(number)] = result;
  }
  section.paragraphs = {
      "The scenes in which everything is measured: spheres of one size, red and transparent in turn, above a plane. "
      "They "
      "are drawn without shadows, which the text does not name, and without a curve to the screen."};
  if (!scenarios.empty())
    section.paragraphs.push_back(
        "The text does not say what becomes of an even grid whose number of spheres is no cube number. Ours begins "
        "anew at its first place, so that some spheres have the place of another: " +
        coinciding_text(scenarios) + ". With it the leaves of two spheres in Table 4.2 come out.");
  section.data = {{"scenarios", std::move(scenarios)}, {"statements", statements.data()}};
  if (!statements.empty()) statements.move_into(section);
  return section;
}

}  // namespace

Experiment figure_4_1() {
  return {kId, "Figure 4.1: the three scenarios", steps_of, section_of};
}

}  // namespace bihive::cli::thesis
