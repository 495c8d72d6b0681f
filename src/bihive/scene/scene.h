// The content of a picture, and its author's settings.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/geometry/clip.h"
#include "bihive/geometry/plane.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/material.h"
#include "bihive/settings/picture_settings.h"

namespace bihive {

class CavityWalls;

/// White light of strength 1 unless coloured; no fall-off with distance. A light with a radius is a bright ball and
/// casts soft shadows.
struct PointLight {
  Vec3d position;
  Vec3d colour{1, 1, 1};
  double radius = 0;  ///< world units, >= 0; without shadows it has no effect
};

/// Squares of `size` world units; the material's colour where floor(u / size) + floor(v / size) is even,
/// `second_colour` where it is odd, the mean of both beyond `fade_distance` from SphereSet::origin(), from which u and
/// v count: that of the world unless the spheres are far from it.
struct Checker {
  double size = 5;
  Vec3d second_colour{0.6, 0.6, 0.6};
  double fade_distance = 500;
};

struct ScenePlane {
  Plane plane;
  Material material;
  std::optional<Checker> checker;
  /// It is seen by its shadows alone: it sends the background, times the share of direct and ambient light that arrives
  /// of what would without spheres (render/shading.h: unshadowed_share()). Where the picture has opacity instead of a
  /// background, its shadows are black with the opacity of what is missing. Not drawn by the GPU.
  bool shadows_only = false;
};

struct Scene {
  SphereSet spheres;
  /// Between the spheres, in the appearance of those at their ends, which are equally clear (check_sticks()).
  StickSet sticks;
  std::vector<Material> materials{matte_material()};  ///< at least one
  std::vector<std::int32_t> material_of_sphere;       ///< positions in `materials`; empty: all use the first
  std::vector<std::int64_t> id_in_input;              ///< of each sphere, if some are hidden; empty: its position
  std::int64_t size_of_input = 0;                     ///< spheres with the hidden ones; 0: none is hidden
  /// The meaning of the spheres' colours, as returned by colour_by(): their elements, types or numbers. Only the legend
  /// depends on it (scene/legend.h).
  std::vector<ColourBy> coloured_by;
  /// Positions in `coloured_by`, -1: the colour has no meaning, -2 - n: the name n of `legend_names`. Empty: all have
  /// the first of `coloured_by`, if there is one.
  std::vector<std::int32_t> coloured_by_of_sphere;
  std::vector<std::string> legend_names;  ///< of coloured selections
  /// The meaning of the colours of arrows (scene/arrows.h) and links (scene/links.h), as returned by colour_by().
  std::vector<ColourBy> sticks_coloured_by;
  /// What colour_by() gives elements: linear RGB by atomic number, 0: unknown. Empty: element_colour() (palette.h).
  std::vector<Vec3f> element_colours;
  std::string length_unit;  ///< of the input's format ("Å"); empty: unknown
  std::vector<PointLight> lights;
  std::optional<ScenePlane> plane;
  /// Pictures show these walls in place of whole spheres, which are those that line them (scene/cavities.h). Null:
  /// whole spheres.
  std::shared_ptr<const CavityWalls> cavity_walls;
  std::vector<Clip> clips;  ///< SphereAttributes::clips selects the spheres of each; at most kMostClips
  Camera camera;
  Vec3d background{1, 1, 1};          ///< linear radiance
  Vec3d ambient_light{1, 1, 1};       ///< multiplies the ambient term
  PictureSettings picture;            ///< the author's settings; a user may override them
  std::string name;                   ///< for messages and the picture's text chunks
  std::optional<std::uint64_t> seed;  ///< of a generated scene
};

/// The id that users see: a sphere's position in the input, hidden spheres counted. Negative ids (nothing, the plane)
/// stay what they are. Images are counted copy by copy, as if nothing were hidden.
inline std::int64_t input_id(const Scene& scene, std::int64_t id) {
  if (id < 0 || scene.id_in_input.empty()) return id;
  const std::int64_t of_stored = scene.id_in_input[static_cast<std::size_t>(scene.spheres.stored_id(id))];
  return of_stored + id / scene.spheres.size() * scene.size_of_input;
}

/// The sphere whose appearance a surface has, by the id of a hit: the sphere itself, or the one at the end of half a
/// stick. Negative ids stay what they are.
inline std::int64_t shown_sphere(const Scene& scene, std::int64_t id) {
  const std::int64_t half = id - scene.spheres.total_size();
  return half < 0 ? id : scene.sticks.sphere_at(scene.spheres, half);
}

/// An Error where the scene has a stick that pictures cannot show as they should: between spheres that are not equally
/// clear.
Status check_sticks(const Scene& scene);

/// As rays see them: relative to the origin of the spheres.
inline Camera local_camera(const Scene& scene) {
  return relative_to(scene.camera, scene.spheres.origin());
}
std::vector<PointLight> local_lights(const Scene& scene);
/// The scene must have a plane.
inline Plane local_plane(const Scene& scene) {
  return {scene.spheres.to_local(scene.plane->plane.point), scene.plane->plane.normal};
}

/// Whether some light casts soft shadows.
bool has_soft_light(const Scene& scene);

/// Whether some sphere has outlines of its own: a width, or creases.
bool has_own_lines(const Scene& scene);

/// Whether a material of the list or of the plane has effects.
bool has_effects(const Scene& scene);

/// Whether some sphere or stick transmits light, straight or refracted.
bool lets_light_through(const Scene& scene);

/// Whether two spheres, by their ids, transmit the same share of light in the same way.
bool are_equally_clear(const Scene& scene, std::int64_t one, std::int64_t other);

/// The material of one sphere, from the list. A colour attribute replaces the colour. An opacity a below 1 scales
/// ambient, diffuse, specular and glow by a, and 1 - a of the light goes straight through (index 1).
Material material_of(const Scene& scene, std::int64_t sphere_id);

/// The material of a surface, by the id of a hit on a sphere or a stick: that of shown_sphere(), with the colour and
/// the opacity that the stick has of its own.
Material shown_material(const Scene& scene, std::int64_t id);

}  // namespace bihive
