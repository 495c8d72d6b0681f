// Figure 4.2: four spheres at recursion depths 1 to 5, and the depth that each pixel needs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/base/timer.h"
#include "bihive/image/image_diff.h"
#include "bihive/math/quartiles.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/views.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "thesis/compare.h"
#include "thesis/pictures.h"

namespace bihive::cli::thesis {
namespace {

const std::string kId = "figure-4.2";
constexpr int kQuickDivisor = 4;
constexpr const char* kTimesStep = "times";
constexpr int kTimeRounds = 9, kQuickTimeRounds = 7;  // a round before them warms up
// Half a step of a picture's 8 bits.
constexpr double kHalfStep = 0.5 / 255;

int depth_of(double value) {
  return static_cast<int>(std::clamp(value, 1.0, 16.0));
}
std::string step_name(double depth) {
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

// The pixels, row by row, whose ray meets a transparent sphere first.
std::vector<std::size_t> transparent_pixels(const Scene& scene, const Tracer& tracer, PictureSize size) {
  const PixelRays rays(scene.camera, size.width_px, size.height_px);
  std::vector<std::size_t> pixels;
  for (int y = 0; y < size.height_px; ++y)
    for (int x = 0; x < size.width_px; ++x) {
      const SceneHit hit = scene_hit(scene, tracer, rays.at(x + 0.5, y + 0.5));
      if (hit.id >= 0 && material_of(scene, hit.id).transmissive > 0)
        pixels.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width_px) +
                         static_cast<std::size_t>(x));
    }
  return pixels;
}

// The brightness of the transparent sphere, and whether it has a colour.
Json sphere_facts(const Image& image, const std::vector<std::size_t>& pixels) {
  std::vector<double> brightness;
  std::int64_t coloured = 0;
  for (const std::size_t i : pixels) {
    const Pixel pixel = pixel_at(image, i);
    brightness.push_back(pixel.brightness());
    if (!pixel.grey()) ++coloured;
  }
  if (brightness.empty()) return {{"pixels", 0}};
  return {{"pixels", pixels.size()},
          {"coloured_pixels", coloured},
          {"brightness_median", quartiles_of(brightness).median},
          {"brightness_mean", spread_of(brightness).mean}};
}

Json draw_depth(const StepContext& context, double depth) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  const PictureSize size = picture_size(context.settings, context.values, kQuickDivisor);
  RenderSettings settings = picture_settings(context, scene, size, View::shaded);
  settings.recursion = depth_of(depth);
  const std::optional<Image> image = draw(context, scene, tracer, settings);
  if (!image) return {};
  Json result{{"picture", write_picture(context, step_name(depth) + ".png", *image)},
              {"transparent_sphere", sphere_facts(*image, transparent_pixels(scene, tracer, size))}};

  // The share of the picture that would change with one generation of rays less.
  if (settings.recursion > 1) {
    --settings.recursion;
    const std::optional<Image> before = draw(context, scene, tracer, settings);
    if (!before) return {};
    result["changed_pixels"] = difference_of(*image, *before).pixels;
  }
  return result;
}

Json draw_coding(const StepContext& context) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  const PictureSize size = picture_size(context.settings, context.values, kQuickDivisor);
  RenderSettings settings = picture_settings(context, scene, size, View::recursion);
  settings.recursion = depth_of(context.values.number("coding.depth"));
  const std::optional<Image> image = draw(context, scene, tracer, settings);
  if (!image) return {};

  // Count the pixels of each depth by its colour.
  Json depths = Json::array();
  for (int depth = 0; depth <= settings.recursion; ++depth) {
    const Vec3d colour = recursion_colour(depth);
    std::int64_t pixels = 0;
    for (std::size_t i = 0; i < image->rgb.size() / 3; ++i) {
      const Pixel pixel = pixel_at(*image, i);
      if (Vec3d{pixel.r / 255.0, pixel.g / 255.0, pixel.b / 255.0} == colour) ++pixels;
    }
    depths.push_back({{"depth", depth}, {"colour", numbers_of(colour)}, {"pixels", pixels}});
  }
  std::int64_t transparent = 0;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id)
    if (material_of(scene, id).transmissive > 0) ++transparent;
  return {{"picture", write_picture(context, "depth_colours.png", *image)},
          {"pixels", image->rgb.size() / 3},
          {"depths", std::move(depths)},
          {"spheres", scene.spheres.size()},
          {"transparent_spheres", transparent}};
}

// Milliseconds of a frame of each depth, round by round, by the reference engine and by the wide one.
Json time_depths(const StepContext& context) {
  const Scene scene = four_spheres_scene();
  const PictureSize size = picture_size(context.settings, context.values, kQuickDivisor);
  Json all = Json::object();
  for (const auto& [name, engine] : {std::pair{"reference", Engine::reference}, {"wide", Engine::wide}}) {
    const Tracer tracer = value_or_fail(Tracer::build(scene.spheres, engine));
    Json& times = all[name] = Json::object();
    for (int round = 0; round <= (context.settings.quick ? kQuickTimeRounds : kTimeRounds); ++round)
      for (const double depth : context.values.numbers("depths")) {
        RenderSettings settings = picture_settings(context, scene, size, View::shaded);
        settings.recursion = depth_of(depth);
        const Timer timer;
        if (!draw(context, scene, tracer, settings)) return {};
        if (round > 0) times[step_name(depth)].push_back(timer.elapsed_ms());
      }
  }
  return all;
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  const double weight = settings.quick ? 0.1 : 1.5;
  std::vector<Step> steps;
  for (const double depth : values.numbers("depths"))
    steps.push_back(
        {step_name(depth), 2 * weight, [depth](StepContext& context) { return draw_depth(context, depth); }});
  steps.push_back({kTimesStep, 4 * weight, [](StepContext& context) { return time_depths(context); }});
  steps.push_back({"coding", weight, [](StepContext& context) { return draw_coding(context); }});
  return steps;
}

// The colour of each depth, and the share of the picture that needs it.
void add_coding(Section& section, Statements& statements, const Values& values, const Json& coding) {
  Table table;
  table.title = "Figure 4.2f: the deepest generation of rays that hits something";
  table.columns = {"Recursion depth", "Colour", "Pixels", "Share"};
  const double all = coding.at("pixels").get<double>();
  double sum = 0;
  std::string legend;
  for (const Json& entry : coding.at("depths")) {
    const int depth = entry.at("depth").get<int>();
    const std::string name = depth == 0 ? "coding.no_hit.colour" : fmt::format("coding.depth{}.colour", depth);
    const auto colour = entry.at("colour").get<std::vector<double>>();
    const auto pixels = entry.at("pixels").get<std::int64_t>();
    const double share = 100 * double(pixels) / all;
    const std::string word = values.has(name) ? values.printed(name) : vector_text(colour);
    table.rows.push_back({{depth == 0 ? "nothing hit" : fmt::format("{}", depth)},
                          {word},
                          {fmt::format("{}", pixels)},
                          {fmt::format("{:.2f} %", share)}});
    legend += fmt::format("{}{} {} {:.2f} %", legend.empty() ? "" : ", ", word,
                          depth == 0 ? "nothing hit" : fmt::format("depth {}", depth), share);
    sum += share;
    if (values.has(name))
      statements.add(name, depth == 0 ? "Colour of no hit" : fmt::format("Colour of depth {}", depth),
                     {word, values.kind(name)}, vector_text(colour), verdict_if(values.numbers(name) == colour));
    const std::vector<double> depths = values.numbers("depths");
    if (std::count(depths.begin(), depths.end(), double(depth)) > 0)
      statements.add(fmt::format("depth{}.somewhere", depth), fmt::format("Depth {} is the deepest somewhere", depth),
                     {"yes", ValueKind::inferred}, fmt::format("{:.2f} % of the pixels", share),
                     verdict_if(pixels > 0));
  }
  table.rows.push_back({{"all"}, {""}, {fmt::format("{:.0f}", all)}, {fmt::format("{:.2f} %", sum)}});
  section.tables.push_back(std::move(table));
  section.illustrations.push_back(illustration_of(kId, coding.at("picture"), "Depth colours: " + legend));
  const auto count = [&](const std::string& name, const std::string& statement) {
    const auto ours = coding.at(name).get<std::int64_t>();
    statements.add(name, statement, {values, name}, fmt::format("{}", ours), verdict_if(values.integer(name) == ours));
  };
  count("spheres", "Spheres");
  count("transparent_spheres", "Transparent ones");
}

// Is the transparent sphere dark grey without its transmitted light?
void add_dark_grey(Statements& statements, const Values& values, const StepResults& results) {
  const auto found = results.find(step_name(values.number("dark_grey.depth")));
  if (found == results.end()) return;
  const Json& sphere = found->second.at("transparent_sphere");
  const std::vector<double> range = values.numbers("dark_grey.radiance");
  if (sphere.at("pixels").get<std::int64_t>() == 0 || range.size() != 2) return;
  const double median = sphere.at("brightness_median").get<double>();
  const auto coloured = sphere.at("coloured_pixels").get<std::int64_t>();
  statements.add("dark_grey.radiance",
                 fmt::format("The transparent sphere is dark grey at depth {}", values.number("dark_grey.depth")),
                 {fmt::format("dark grey ({} to {})", range[0], range[1]), values.kind("dark_grey.radiance")},
                 fmt::format("{:.3f} in the middle, {} of {} pixels coloured", median, coloured,
                             sphere.at("pixels").get<std::int64_t>()),
                 verdict_if(coloured == 0 && median >= range[0] - kHalfStep && median <= range[1] + kHalfStep));
}

// The text limits the depth "for processing time feasibility reasons": what does each generation cost?
void add_times(Section& section, Statements& statements, const Values& values, const StepResults& results) {
  const auto found = results.find(kTimesStep);
  if (found == results.end()) return;
  Table table{"Time of a frame by recursion depth", {"Recursion depth"}, {}, ""};
  for (const double depth : values.numbers("depths")) table.rows.push_back({{fmt::format("{}", depth)}});
  for (const auto& [engine, times] : found->second.items()) {
    table.columns.push_back(engine + ": ms, with quartiles");
    table.columns.push_back(engine + ": times depth " + table.rows.front().front().text);
    std::vector<double> first, before;
    std::vector<Quartiles> growth;
    std::size_t row = 0;
    for (const auto& [depth, list] : times.items()) {
      const auto ms = list.get<std::vector<double>>();
      if (first.empty()) first = ms;
      std::vector<double> to_first, to_before;
      for (std::size_t i = 0; i < ms.size(); ++i) {
        to_first.push_back(ms[i] / first[i]);
        if (!before.empty()) to_before.push_back(ms[i] / before[i]);
      }
      if (!to_before.empty()) growth.push_back(quartiles_of(to_before));
      before = ms;
      table.rows[row].push_back({quartiles_text(quartiles_of(ms), 2)});
      table.rows[row++].push_back({fmt::format("{:.2f}", quartiles_of(to_first).median)});
    }
    Verdict verdict = Verdict::agrees;
    std::string factors;
    for (const Quartiles& each : growth) {
      const Verdict one = verdict_above(each, 1);
      if (one == Verdict::differs || verdict == Verdict::agrees) verdict = one;
      factors += (factors.empty() ? "" : ", ") + fmt::format("{:.2f}", each.median);
    }
    statements.add(engine + ".time_grows", "Each depth takes longer than the one before (engine " + engine + ")",
                   {"longer", ValueKind::inferred}, "times " + factors, verdict, "", /*timed=*/true);
  }
  table.note =
      "The text limits the depth \"for processing time feasibility reasons\" and gives no times. Medians over rounds "
      "in "
      "which the depths take turns.";
  section.tables.push_back(std::move(table));
}

Section section_of(const SectionContext& context) {
  Section section;
  const Values& values = context.values;
  Statements statements("What the text says of Figure 4.2",
                        "Numbers and colours agree if they are the same. The sphere is dark grey if none of its pixels "
                        "has a colour and the median of their values lies in the range, which we infer from Table 4.1: "
                        "the text has no number. Each depth must be the deepest one in at least one pixel: the text "
                        "names a colour for each, and we infer that its picture shows all of them.");
  Table depths;
  depths.title = "What each recursion depth adds";
  depths.columns = {"Recursion depth", "Pixels changed by its last generation", "Mean value of the transparent sphere"};
  Json by_depth = Json::object();
  for (const double depth : values.numbers("depths")) {
    const auto found = context.results.find(step_name(depth));
    if (found == context.results.end()) continue;
    const Json& result = found->second;
    const Json& sphere = result.at("transparent_sphere");
    depths.rows.push_back(
        {{fmt::format("{}", depth)},
         {result.contains("changed_pixels") ? result.at("changed_pixels").dump() : ""},
         {sphere.contains("brightness_mean") ? fmt::format("{:.3f}", sphere.at("brightness_mean").get<double>())
                                             : ""}});
    section.illustrations.push_back(
        illustration_of(kId, result.at("picture"), fmt::format("Recursion depth {}", depth)));
    by_depth[step_name(depth)] = result;
  }
  if (!depths.rows.empty()) section.tables.push_back(std::move(depths));
  add_dark_grey(statements, values, context.results);
  const auto coding = context.results.find("coding"), times = context.results.find(kTimesStep);
  if (coding != context.results.end()) add_coding(section, statements, values, coding->second);

  section.paragraphs = {
      "Red spheres and a transparent one, placed by us, since the text gives no places: large and close "
      "together, "
      "so that each of the depths is the deepest that some pixel needs. Depth 1 is the primary ray alone; each "
      "reflection and each transmission adds one."};
  add_times(section, statements, values, context.results);
  section.data = {{"depths", std::move(by_depth)},
                  {"coding", coding != context.results.end() ? coding->second : Json()},
                  {"times", times != context.results.end() ? times->second : Json()},
                  {"statements", statements.data()}};
  if (!statements.empty()) statements.move_into(section);
  return section;
}

}  // namespace

Experiment figure_4_2() {
  return {kId, "Figure 4.2: recursion depth", steps_of, section_of};
}

}  // namespace bihive::cli::thesis
