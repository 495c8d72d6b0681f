// The writing half of scene_file.h.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bihive/geometry/rounding_loss.h"
#include "bihive/scene/scene_file.h"
#include "bihive/settings/parameter_json.h"

namespace bihive {
namespace {

// The shortest text that reads as the same number again. JSON keeps the sign of -0 only in a fraction.
std::string number(double value) {
  return value == 0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value);
}

// The same for a stored coordinate in world units: it has 24 bits, so fewer digits are enough. Not used if they could
// round up beyond the range of binary32.
std::string coordinate(double world) {
  const float rounded = static_cast<float>(world);
  return std::isnormal(rounded) && double(rounded) == world && std::abs(world) < 3.4e38 ? fmt::format("{}", rounded)
                                                                                        : number(world);
}

std::string vector(Vec3d v) {
  return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
}

std::string text(const std::string& value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// With a leading comma, or empty.
std::string effect_members(const Material& m) {
  if (!has_effects(m)) return "";
  return fmt::format(R"(, "tint": {}, "bands": {}, "glow": {})", number(m.tint), m.bands, number(m.glow));
}

// The members of a material, without braces.
std::string members(const Material& m) {
  return fmt::format(
             R"("colour": {}, "ambient": {}, "diffuse": {}, "reflective": {}, "specular": {}, "power": {}, "transmissive": {}, "refraction_index": {})",
             vector(m.colour), number(m.ambient), number(m.diffuse), number(m.reflective), number(m.specular),
             number(m.power), number(m.transmissive), number(m.refraction_index)) +
         effect_members(m);
}

void write_materials(const Scene& scene, std::string& out) {
  out += "  \"materials\": [\n";
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    out += fmt::format("    {{\"name\": \"material {}\", {}}}{}\n", i, members(scene.materials[i]),
                       i + 1 < scene.materials.size() ? "," : "");
  out += "  ],\n";
}

void write_plane(const ScenePlane& plane, std::string& out) {
  out += fmt::format("  \"plane\": {{\n    \"point\": {}, \"normal\": {},\n    \"material\": {{{}}}",
                     vector(plane.plane.point), vector(plane.plane.normal), members(plane.material));
  if (plane.checker)
    out += fmt::format(",\n    \"checker\": {{\"size\": {}, \"second_colour\": {}, \"fade_distance\": {}}}",
                       number(plane.checker->size), vector(plane.checker->second_colour),
                       number(plane.checker->fade_distance));
  if (plane.shadows_only) out += ",\n    \"shadows_only\": true";
  out += "\n  },\n";
}

std::string clip_text(const PlaneClip& plane) {
  return fmt::format(R"({{"plane": {{"normal": {}, "offset": {}}}}})", vector(plane.normal), number(plane.offset));
}
std::string clip_text(const BoxClip& box) {
  return fmt::format(R"({{"box": {{"lo": {}, "hi": {}}}}})", vector(box.lo), vector(box.hi));
}
std::string clip_text(const SphereClip& sphere) {
  return fmt::format(R"({{"sphere": {{"centre": {}, "radius": {}}}}})", vector(sphere.centre), number(sphere.radius));
}

void write_clips(const Scene& scene, std::string& out) {
  out += "  \"clips\": [\n";
  for (std::size_t i = 0; i < scene.clips.size(); ++i)
    out += "    " + std::visit([](const auto& clip) { return clip_text(clip); }, scene.clips[i]) +
           (i + 1 < scene.clips.size() ? ",\n" : "\n");
  out += "  ],\n";
}

// The positions of the clips whose bits are set.
std::string clip_positions(std::uint64_t bits) {
  std::string positions;
  for (int k = 0; k < kMostClips; ++k)
    if ((bits >> k & 1) != 0) positions += (positions.empty() ? "" : ", ") + std::to_string(k);
  return positions;
}

void write_sphere(const Scene& scene, std::int64_t id, bool all_digits, std::string& out) {
  const std::size_t i = static_cast<std::size_t>(id);
  const SphereSet& spheres = scene.spheres;
  const SphereAttributes& attributes = spheres.attributes();
  const Vec3d centre = spheres.centre(id);
  const auto of_axis = [&](int axis) { return all_digits ? number(centre[axis]) : coordinate(centre[axis]); };
  const std::string xyz = of_axis(0) + ", " + of_axis(1) + ", " + of_axis(2);
  const std::string radius = coordinate(spheres.radius(id));
  const std::int32_t material = scene.material_of_sphere.empty() ? 0 : scene.material_of_sphere[i];
  const bool plain = attributes.colour.empty() && attributes.opacity.empty() && attributes.outline_px.empty() &&
                     attributes.crease.empty() && attributes.clips.empty();
  if (plain) {
    out += "    [" + xyz + ", " + radius + (material == 0 ? "" : fmt::format(", {}", material)) + "]";
    return;
  }
  out += fmt::format("    {{\"centre\": [{}], \"radius\": {}", xyz, radius);
  if (material != 0) out += fmt::format(", \"material\": {}", material);
  if (!attributes.colour.empty()) {
    const Vec3f colour = attributes.colour[i];
    out += fmt::format(", \"colour\": [{}, {}, {}]", colour.x, colour.y, colour.z);
  }
  if (!attributes.opacity.empty()) out += fmt::format(", \"opacity\": {}", attributes.opacity[i]);
  if (!attributes.outline_px.empty() && attributes.outline_px[i] >= 0)
    out += fmt::format(", \"outline\": {}", attributes.outline_px[i]);
  if (!attributes.crease.empty()) out += fmt::format(", \"crease\": {}", attributes.crease[i]);
  if (!attributes.clips.empty() && attributes.clips[i] != 0)
    out += ", \"clips\": [" + clip_positions(attributes.clips[i]) + "]";
  out += "}";
}

// With its comma, or empty.
std::string projection_members(const Camera& camera) {
  if (camera.projection == Projection::perspective) return "";
  return fmt::format(", \"projection\": \"orthographic\", \"shorter_side\": {}", number(camera.shorter_side));
}

std::string lens_members(const Camera& camera) {
  if (camera.aperture == 0) return "";
  const std::string focus = camera.focus == 0 ? "" : fmt::format(", \"focus\": {}", number(camera.focus));
  return fmt::format(", \"aperture\": {}", number(camera.aperture)) + focus;
}

// The cell and the copies, with their line ends.
std::string cell_members(const SphereSet& spheres) {
  std::string members;
  if (const std::optional<Cell>& cell = spheres.cell()) {
    members += fmt::format("  \"cell\": {{\"vectors\": [{}, {}, {}], \"origin\": {}", vector(cell->vectors[0]),
                           vector(cell->vectors[1]), vector(cell->vectors[2]), vector(cell->origin));
    const auto& [a, b, c] = cell->periodic;
    if (!(a && b && c)) members += fmt::format(", \"periodic\": [{}, {}, {}]", a, b, c);
    members += "},\n";
  }
  const auto& [a, b, c] = spheres.images().counts;
  if (spheres.has_images()) members += fmt::format("  \"replicate\": [{}, {}, {}],\n", a, b, c);
  return members;
}

bool has_ambient_light(const Scene& scene) {
  const Vec3d light = scene.ambient_light;
  return light.x != 1 || light.y != 1 || light.z != 1;
}

bool has_own_outlines(const Scene& scene) {
  const SphereAttributes& attributes = scene.spheres.attributes();
  return !attributes.outline_px.empty() || !attributes.crease.empty();
}

// The oldest version of the format that can hold the scene.
int version_of(const Scene& scene) {
  const bool parallel = scene.camera.projection != Projection::perspective;
  return picture_version(scene.picture) > 1 || !lens_members(scene.camera).empty() || has_soft_light(scene) ||
                 has_effects(scene) || has_own_outlines(scene) || has_ambient_light(scene) || parallel ||
                 !scene.clips.empty() || scene.spheres.cell() || (scene.plane && scene.plane->shadows_only)
             ? 2
             : 1;
}

}  // namespace

std::string scene_to_json(const Scene& scene) {
  const Camera& camera = scene.camera;
  std::string out = fmt::format("{{\n  \"bihive_scene\": {},\n", version_of(scene));
  if (!scene.name.empty()) out += "  \"name\": " + text(scene.name) + ",\n";
  if (scene.seed) out += fmt::format("  \"seed\": {},\n", *scene.seed);
  out += fmt::format("  \"camera\": {{\"eye\": {}, \"look_at\": {}, \"up\": {}, \"fov_deg\": {}{}{}}},\n",
                     vector(camera.eye), vector(camera.look_at), vector(camera.up), number(camera.fov_deg),
                     projection_members(camera), lens_members(camera));
  out += "  \"lights\": [";
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    out += fmt::format("{}{{\"position\": {}, \"colour\": {}{}}}", i == 0 ? "" : ", ", vector(scene.lights[i].position),
                       vector(scene.lights[i].colour),
                       scene.lights[i].radius == 0 ? "" : ", \"radius\": " + number(scene.lights[i].radius));
  out += "],\n";
  write_materials(scene, out);
  if (scene.plane) write_plane(*scene.plane, out);
  if (!scene.clips.empty()) write_clips(scene, out);
  out += "  \"background\": " + vector(scene.background) + ",\n";
  if (has_ambient_light(scene)) out += "  \"ambient_light\": " + vector(scene.ambient_light) + ",\n";
  out += "  \"picture\": " + picture_to_json(scene.picture) + ",\n";
  out += cell_members(scene.spheres);
  out += "  \"spheres\": [\n";
  const bool all_digits = needs_all_digits(scene.spheres);
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    write_sphere(scene, id, all_digits, out);
    out += id + 1 < scene.spheres.size() ? ",\n" : "\n";
  }
  out += "  ]\n}\n";
  return out;
}

}  // namespace bihive
