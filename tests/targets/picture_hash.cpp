// Prints one line for each of a set of small pictures: its name, and the hash of its pixels.
//
// Built natively and as WebAssembly; both must print the same lines. It also compares the engines and thread counts
// with each other, and fails if a picture differs. The pictures: the three scenarios, the four spheres and the bundled
// molecule; recursion 1 to 5, ambient occlusion, soft shadows with effects of materials, outlines and fog, every view,
// parallel rays, labels, a lens, tone curves, adaptive samples, a part with opacity, the sRGB curve, shadows, several
// samples; a replicated set with its cell.
#include <cinttypes>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "bihive/image/png_pixels.h"
#include "bihive/io/bundled.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/looks.h"
#include "bihive/scene/palette.h"
#include "support/effort.h"

namespace {

using bihive::Engine;
using bihive::View;

constexpr int kWidthPx = 96;
constexpr int kHeightPx = 72;

struct NamedView {
  const char* name;
  View view;
};
constexpr NamedView kViews[] = {{"recursion", View::recursion},
                                {"traversal", View::traversal},
                                {"normal", View::normal},
                                {"distance", View::distance},
                                {"id", View::id},
                                {"tree", View::tree}};

struct NamedEngine {
  const char* name;
  Engine engine;
};
constexpr NamedEngine kEngines[] = {{"auto", Engine::automatic}, {"reference", Engine::reference}};

// The bundled molecule as the program shows it: coloured by element, framed, white background, with shadows.
bihive::Result<bihive::Scene> molecule_scene() {
  auto file = bihive::read_spheres_from_memory(bihive::bundled_molecule(), "1hpv.pdb", {});
  if (!file) return file.error();
  bihive::Scene scene;
  scene.name = "molecule";
  scene.spheres = std::move(file->spheres);
  bihive::colour_spheres(scene.spheres);
  scene.camera = bihive::frame_spheres(scene.spheres, bihive::ViewFrom::front, 30, kWidthPx, kHeightPx);
  scene.lights = {bihive::light_behind(scene.camera)};
  return scene;
}

// Prints the picture's line. False if the picture cannot be made, or if it depends on engine or threads.
bool print_hash(const bihive::Scene& scene, const bihive::RenderSettings& wanted, const char* view_name) {
  bool good = true;
  bool have_first = false;
  std::uint64_t first = 0;
  for (const auto& [engine_name, engine] : kEngines) {
    // The pictures of the tree and of its traversal show the reference tree.
    const bool of_tree = wanted.view == View::traversal || wanted.view == View::tree;
    if (of_tree && engine != Engine::reference) continue;
    // On a very slow emulator, the engine without code for its instruction set draws nothing else.
    if (!of_tree && engine == Engine::reference && bihive::test::test_share() > 32) continue;
    const auto built = bihive::Tracer::build(scene.spheres, engine);
    if (!built) {
      std::fprintf(stderr, "%s: %s\n", scene.name.c_str(), built.error().to_string().c_str());
      return false;
    }
    const bihive::Tracer& tracer = *built;
    for (const int threads : {1, 4}) {
      bihive::RenderSettings settings = wanted;
      settings.threads = threads;
      const auto rendered = bihive::render(scene, tracer, settings);
      if (!rendered) {
        std::fprintf(stderr, "%s: %s\n", scene.name.c_str(), rendered.error().to_string().c_str());
        return false;
      }
      const bihive::Transfer curve = settings.view == View::shaded ? scene.picture.transfer : bihive::Transfer::none;
      bihive::PngPixels pixels = bihive::png_pixels_from_film(rendered->film, curve, 8);
      bihive::draw_labels(pixels, scene, settings);
      const std::uint64_t hash = bihive::picture_hash(pixels);
      std::printf("%s view %s recursion %d samples %d engine %s threads %d: %016" PRIx64 "\n", scene.name.c_str(),
                  view_name, settings.recursion, settings.samples_per_pixel, engine_name, threads, hash);
      if (!have_first) first = hash;
      have_first = true;
      if (hash != first) {
        std::fprintf(stderr, "%s view %s recursion %d: engine %s with %d threads makes another picture\n",
                     scene.name.c_str(), view_name, settings.recursion, engine_name, threads);
        good = false;
      }
    }
  }
  return good;
}

// The scene with soft lights and materials with effects.
bihive::Scene with_look(bihive::Scene scene) {
  bihive::LightRig rig = *bihive::value_named(bihive::light_presets(), "studio");
  scene.lights = bihive::lights_around(rig, scene.camera);
  scene.ambient_light = rig.ambient_light;
  for (bihive::Material& material : scene.materials) {
    material.tint = 0.5;
    material.bands = 3;
    material.glow = 0.1;
  }
  return scene;
}

// Every third sphere lets light straight through.
bihive::Scene with_opacities(bihive::Scene scene) {
  std::vector<float>& opacity = scene.spheres.attributes().opacity;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) opacity.push_back(id % 3 == 0 ? 0.4F : 1.0F);
  return scene;
}

bihive::RenderSettings look_settings(bihive::RenderSettings settings) {
  settings.recursion = 2;
  settings.shadows = true;
  settings.light_points = 3;
  settings.outline = bihive::Outline{1.5, 0.5, {0.1, 0, 0}};
  settings.fog = bihive::Fog{0.2, 0.9, 0.5};
  return settings;
}

// With every label, whole and in part; the two are different pictures with lines of their own.
bool print_labels(bihive::Scene scene) {
  bihive::ColourBy by_height;
  by_height.attribute = "y";
  if (!bihive::apply_looks(scene, {{"all", {by_height}}})) return false;
  scene.camera = bihive::with_projection(scene.camera, bihive::Projection::orthographic);
  bihive::RenderSettings settings = bihive::settings_from(scene.picture);
  settings.width_px = kWidthPx;
  settings.height_px = kHeightPx;
  settings.recursion = 1;
  settings.labels = {true, true, true, "\u00C5ngstr\u00F6m \u03B2\u00B2", "nm"};
  bool good = print_hash(scene, settings, "shaded with labels");
  settings.transparent = true;
  settings.crop = bihive::Tile{20, 3, 90, 70};
  return print_hash(scene, settings, "shaded with labels transparent part") && good;
}

// Pictures with parallel rays: shaded in one step, shaded with all that follows, and the tree's views.
bool print_orthographic(bihive::Scene scene) {
  scene.camera = bihive::with_projection(scene.camera, bihive::Projection::orthographic);
  bihive::RenderSettings settings = bihive::settings_from(scene.picture);
  settings.width_px = kWidthPx;
  settings.height_px = kHeightPx;
  settings.recursion = 5;
  bool good = print_hash(scene, settings, "shaded orthographic");
  settings.recursion = 1;
  settings.shadows = false;
  good = print_hash(scene, settings, "shaded orthographic") && good;
  settings.view = View::distance;
  good = print_hash(scene, settings, "distance orthographic") && good;
  settings.view = View::tree;
  return print_hash(scene, settings, "tree orthographic") && good;
}

// Pictures with tone curves, by a lens, with more samples on edges.
bool print_photographs(bihive::Scene scene) {
  bihive::RenderSettings settings = bihive::settings_from(scene.picture);
  settings.width_px = kWidthPx;
  settings.height_px = kHeightPx;
  settings.recursion = 2;
  settings.tone = {0.75, bihive::ToneCurve::soft};
  bool good = print_hash(scene, settings, "shaded with a soft tone");
  settings.tone = {-0.5, bihive::ToneCurve::filmic};
  settings.adaptive_samples = true;
  good = print_hash(scene, settings, "shaded with a filmic tone and adaptive samples") && good;
  settings.adaptive_samples = false;
  settings.tone = {};
  settings.samples_per_pixel = 5;
  scene.camera.aperture = 0.02 * length(scene.camera.look_at - scene.camera.eye);
  return print_hash(scene, settings, "shaded by a lens") && good;
}

// All pictures of one scene.
bool print_hashes(const bihive::Scene& scene) {
  bool good = true;
  bihive::RenderSettings settings = bihive::settings_from(scene.picture);
  settings.width_px = kWidthPx;
  settings.height_px = kHeightPx;
  for (int recursion = 1; recursion <= 5; ++recursion) {
    settings.recursion = recursion;
    good = print_hash(scene, settings, "shaded") && good;
  }
  bihive::RenderSettings part = settings;
  part.transparent = true;
  part.crop = bihive::Tile{5, 3, 80, 70};
  good = print_hash(scene, part, "shaded transparent part") && good;
  bihive::RenderSettings with_ambient = settings;
  with_ambient.recursion = 2;
  with_ambient.ambient_occlusion = {10, 4};
  good = print_hash(scene, with_ambient, "shaded with ambient occlusion") && good;
  good = print_hash(with_look(scene), look_settings(settings), "shaded with a look") && good;
  bihive::RenderSettings with_opacity = look_settings(settings);
  with_opacity.opacity_rule = bihive::OpacityRule::once;
  with_opacity.ambient_occlusion = {10, 4};
  good = print_hash(with_opacities(with_look(scene)), with_opacity, "shaded with opacity once") && good;
  for (const auto& [name, view] : kViews) {
    settings.view = view;
    good = print_hash(scene, settings, name) && good;
  }
  good = print_photographs(scene) && good;
  good = print_orthographic(scene) && good;
  return print_labels(scene) && good;
}

// Copies of a set along a skewed cell, with its edges; the last ones coloured by their places.
bool print_replicated(bihive::Scene scene) {
  scene.name = "replicated";
  const bihive::SphereSet::Bounds bounds = scene.spheres.bounds();
  const bihive::Vec3d size = bounds.hi - bounds.lo;
  const bihive::Cell cell{bounds.lo,
                          {bihive::Vec3d{size.x, 0, 0}, bihive::Vec3d{0.3 * size.x, size.y, 0.1 * size.z},
                           bihive::Vec3d{0, 0, -1.1 * size.z}}};
  scene.spheres.cell() = cell;
  if (!scene.spheres.replicate(cell.vectors, {2, 1, 3})) return false;
  scene.camera = bihive::frame_spheres(scene.spheres, bihive::ViewFrom::iso, 30, kWidthPx, kHeightPx);
  bihive::RenderSettings settings = bihive::settings_from(scene.picture);
  settings.width_px = kWidthPx;
  settings.height_px = kHeightPx;
  settings.recursion = 3;
  settings.cell_lines.emplace();
  bool good = print_hash(scene, settings, "shaded");
  settings = look_settings(settings);
  settings.opacity_rule = bihive::OpacityRule::once;
  settings.ambient_occlusion = {10, 4};
  good = print_hash(with_opacities(with_look(scene)), settings, "shaded with opacity once") && good;
  bihive::ColourBy by_depth;
  by_depth.attribute = "z";
  if (!bihive::apply_looks(scene, {{"all", {by_depth}}})) return false;
  scene.camera = bihive::with_projection(scene.camera, bihive::Projection::orthographic);
  settings.transparent = true;
  good = print_hash(scene, settings, "shaded orthographic transparent") && good;
  settings.transparent = false;
  settings.view = View::id;
  return print_hash(scene, settings, "id") && good;
}

}  // namespace

int main() {
  bool good = true;
  bihive::ScenarioParameters parameters;
  parameters.count = 256;
  for (const auto scenario : {bihive::Scenario::grid, bihive::Scenario::corners, bihive::Scenario::mixed}) {
    const auto scene = bihive::scenario_scene(scenario, parameters);
    good = scene && print_hashes(*scene) && good;
  }
  good = print_hashes(bihive::four_spheres_scene()) && good;
  const auto molecule = molecule_scene();
  if (!molecule) std::fprintf(stderr, "%s\n", molecule.error().to_string().c_str());
  good = molecule && print_hashes(*molecule) && good;
  const auto repeated = bihive::scenario_scene(bihive::Scenario::mixed, parameters);
  good = repeated && print_replicated(*repeated) && good;
  return good ? 0 : 1;
}
