// Many rays on their way through a picture at once, as structures of arrays: the data that the steps of a wave read and
// write.
//
// Files of this folder: STEP.cpp holds the step of namespace `steps` with that name (and its neighbours), *-inl.h the
// vector code that several steps share, wave_integrator the order of the steps.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/image/film.h"
#include "bihive/image/tone.h"
#include "bihive/render/query/column.h"
#include "bihive/render/query/pixel_order.h"
#include "bihive/render/surface.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/image_colours.h"
#include "bihive/scene/sample_pattern.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/opacity_rule.h"
#include "bihive/wide/ray_batch.h"

namespace bihive {

/// The data of a scene for the steps, prepared once for each picture. The scene must outlive it.
struct WaveScene {
  const Scene* scene;
  double inverse_scale;  ///< world units from stored units, a power of two
  std::vector<Material>
      materials;                ///< the scene's; then, if there is a plane, the plane's of even, odd and far squares
  bool spawns_rays = false;     ///< some material reflects or refracts
  bool has_attributes = false;  ///< some sphere or stick has its own colour or opacity
  bool has_sticks = false;
  bool has_effects = false;  ///< some material has bands, a tint or a glow
  /// What is passed straight sends no ray on: OpacityRule::once. Such materials have a transmissive share of 0 here.
  bool passes_apart = false;
  double faintest_ray = 0;             ///< rays with less weight are not sent on: kFaintestRay with OpacityRule::once
  std::int64_t plane_material = 0;     ///< the plane's first
  Plane plane{};                       ///< local, if the scene has one
  bool shadows_only = false;           ///< ScenePlane::shadows_only
  std::vector<PointLight> lights;      ///< local
  PlaneAxes axes{};                    ///< of the plane, if it has a checker
  std::shared_ptr<const CutSet> cuts;  ///< null: all spheres are whole
  ImageColours image_colours;

  /// rule: each_surface where no sphere is passed straight.
  explicit WaveScene(const Scene& drawn, OpacityRule rule = OpacityRule::each_surface);
};

/// The columns of every kind of ray.
struct RayColumns {
  std::int64_t count = 0;
  Columns3<float> origin, direction;
  Column<std::int64_t> leaves;
  Column<std::uint8_t> inside;

  /// Forgets all rays, and makes room for n.
  void reset(std::int64_t n) {
    count = 0;
    origin.reserve(n);
    direction.reserve(n);
    leaves.reserve(n);
    inside.reserve(n);
  }

  RaySpan span() const {
    RaySpan view;
    view.count = count;
    for (int axis = 0; axis < 3; ++axis) {
      view.origin[axis] = origin[axis].data();
      view.direction[axis] = direction[axis].data();
    }
    view.leaves = leaves.data();
    view.inside = inside.data();
    return view;
  }
};

/// One generation of rays, in the order of their parents. An owner is a sample of a pixel; its rays are neighbours.
struct Wave : RayColumns {
  /// Primary rays: ray i has owner i, weight 1, leaves nothing, and is inside nothing; those columns are unused.
  bool starts_at_eye = false;
  bool has_one_origin = false;  ///< all rays start at the same point
  Column<double> weight;        ///< share of the light along the ray
  bool has_tints = false;
  Columns3<double> tint;  ///< colour of what lies between the ray and the eye; white and unused unless has_tints
  Column<std::int64_t> owner;

  void reset(std::int64_t n, bool with_tints = false) {
    RayColumns::reset(n);
    starts_at_eye = false;
    has_one_origin = false;
    has_tints = with_tints;
    weight.reserve(n);
    if (has_tints) tint.reserve(n);
    owner.reserve(n);
  }

  RaySpan span() const {
    RaySpan view = RayColumns::span();
    if (starts_at_eye) {
      view.leaves = nullptr;
      view.inside = nullptr;
    }
    return view;
  }
};

/// A part of a wave: rays first to before last.
struct WavePart {
  const Wave* wave;
  std::int64_t first, last;

  std::int64_t count() const { return last - first; }
  RaySpan span() const { return wave->span().part(first, count()); }
};

/// The light that each owner has received so far.
struct WaveSums {
  Columns3<double> light;
  bool empty = true;  ///< no owner has received anything; the columns' content is ignored

  void reset(std::int64_t owners) {
    empty = true;
    light.reserve(owners);
  }
  Vec3d at(std::int64_t owner) const { return {light[0][owner], light[1][owner], light[2][owner]}; }
};

/// The places where the rays of a wave hit something, as in render/surface.h; in the order of the rays.
struct WaveSurfaces {
  std::int64_t count = 0;
  Columns3<float> origin;
  Columns3<double> incoming, normal;
  Column<double> weight;
  bool has_tints = false;  ///< of their rays
  Columns3<double> tint;
  Column<std::int64_t> owner, id;
  Column<std::int64_t> material_inside;  ///< 2 x position in WaveScene::materials + (1 if inside a sphere)

  void reset(std::int64_t n, bool with_tints) {
    count = 0;
    has_tints = with_tints;
    if (has_tints) tint.reserve(n);
    origin.reserve(n);
    incoming.reserve(n);
    normal.reserve(n);
    weight.reserve(n);
    owner.reserve(n);
    id.reserve(n);
    material_inside.reserve(n);
  }
};

/// A number for each colour, of many places. Where transparent spheres do not colour the light that passes them, the
/// three rows are one and the same.
struct ColourRows {
  const double* of[3] = {nullptr, nullptr, nullptr};

  ColourRows() = default;
  /// `channels`: 3, or 1 if only the first column is filled.
  ColourRows(const Columns3<double>& columns, int channels)
      : of{columns[0].data(), columns[channels > 1 ? 1 : 0].data(), columns[channels > 1 ? 2 : 0].data()} {}
  explicit operator bool() const { return of[0] != nullptr; }
};

/// Rays from surfaces towards one light, which is at t = 1.
struct ShadowWave : RayColumns {
  Column<double> t_max;
  Column<std::int64_t> surface;  ///< the number of the ray's surface
  Column<std::uint8_t> hidden;
  /// What of the light arrives, only where there are transparent spheres: in three colours, or the first column alone.
  Columns3<double> share;

  /// `channels`: 3 or 1.
  void reset(std::int64_t n, int channels) {
    RayColumns::reset(n);
    t_max.reserve(n);
    surface.reserve(n);
    hidden.reserve(n);
    for (int channel = 0; channel < channels; ++channel) share[channel].reserve(n);
  }

  RaySpan span() const {
    RaySpan view = RayColumns::span();
    view.t_max = t_max.data();
    return view;
  }
};

/// Places on surfaces that take the same set of directions or of a light's points, and their rays to one of these.
struct PlaceWave {
  std::int64_t places = 0;
  Columns3<float> origin;
  Columns3<double> normal;
  Column<std::int64_t> id, inside, surface;  ///< `surface`: its number in WaveSurfaces
  /// Sums so far: of the facings of all rays, of those that nothing hides, and the number of these rays; the last two
  /// with each ray times its share, in `channels` colours.
  Column<double> in_front;
  Columns3<double> seen, rays_seen;
  int channels = 1;

  RayColumns rays;
  Column<double> facing;
  Column<std::int64_t> place;  ///< of each ray
  Column<std::uint8_t> hidden;
  bool has_shares = false;  ///< else the share of each ray is 1
  Columns3<double> share;

  /// `in_colours`: 3 or 1.
  void reset(std::int64_t n, int in_colours) {
    places = 0;
    channels = in_colours;
    origin.reserve(n);
    normal.reserve(n);
    for (Column<std::int64_t>* column : {&id, &inside, &surface, &place}) column->reserve(n);
    for (Column<double>* column : {&in_front, &facing}) column->reserve(n);
    for (int channel = 0; channel < channels; ++channel)
      for (Columns3<double>* columns : {&seen, &rays_seen, &share}) (*columns)[channel].reserve(n);
    rays.reset(n);
    hidden.reserve(n);
  }
};

/// Where primary rays go through the picture and the lens.
struct PicturePositions {
  const double *x, *y;
  const double *lens_x, *lens_y;  ///< read if the camera has a lens
};

/// The steps. Each gives the bits of the scalar code that it names on every instruction set.
namespace steps {

/// PixelRays::at() of the positions of the rays of the wave, whose count is set. Or PixelRays::at() of one place in
/// each of several pixels, without a lens; kColumnPadding other pixels must follow them.
void camera_rays(const PixelRays& pixels, const PicturePositions& positions, Wave& wave);
void camera_rays(const PixelRays& pixels, const PixelPlace* pixel, SamplePlace place, Wave& wave);

/// The test of the plane in scene_hit(): if the plane is nearer than the sphere, it becomes the hit.
void hit_plane(const WaveScene& scene, const WavePart& rays, double* t, std::int64_t* id);

/// surface_at() of all rays that hit something, given the spheres that they hit; this step tests the plane. Rays that
/// miss everything bring the background to their owners.
void find_surfaces(const WaveScene& scene, const WavePart& rays, const double* t, const std::int64_t* id,
                   WaveSurfaces& surfaces, WaveSums& sums);

/// The shadow rays of the surfaces from number `first` on towards one light, as local_light() makes them. Appended to
/// `shadows`.
void find_shadow_rays(const WaveSurfaces& surfaces, std::int64_t first, const PointLight& light, ShadowWave& shadows);

/// The surfaces in groups that take the same directions or points of lights: group level * sets + set has those of
/// faint_level() `level` whose owners have the numbers first_sample + owner = `set` modulo `sets`, after modulo
/// `samples`, in their order.
struct PlaceGroups {
  std::vector<std::int64_t> first;     ///< of each group, in `surfaces`; and their number
  std::vector<std::int64_t> surfaces;  ///< numbers in WaveSurfaces
};
struct Grouping {
  std::int64_t first_sample, samples, sets;
  int levels = 1;
  const std::uint8_t* level_of = nullptr;  ///< of each surface; null: 0
};
void group_places(const WaveSurfaces& surfaces, const Grouping& by, PlaceGroups& groups);

/// The surfaces of one group, for light in `channels` colours (PlaceWave).
void gather_places(const WaveSurfaces& surfaces, const PlaceGroups& groups, std::int64_t group, int channels,
                   PlaceWave& wave);

/// Sets the sums of the places to 0.
void forget_sums(PlaceWave& wave);

/// The rays of ambient_visibility() in one direction from the places that face it. They replace the rays of the last
/// direction.
void find_ambient_rays(Vec3f direction, PlaceWave& wave);

/// The rays of soft_light_share() towards one point of a light, at t = 1, from the places that face it. They replace
/// the rays before.
void find_light_rays(Vec3d point, PlaceWave& wave);

/// Adds the rays that are not hidden to their places, each times its share.
void add_visible(PlaceWave& wave);

/// Previews: the surfaces whose light each surface shares, itself too: those of the same sphere in pixels around it.
struct Neighbours {
  std::vector<std::int64_t> first;    ///< of each surface, in the other columns; and their length
  std::vector<std::int32_t> surface;  ///< numbers in WaveSurfaces
  std::vector<float> weight;
};

/// Of surfaces of primary rays, one at most for each owner. `pixel`: of each owner, in the order of order_pixels(), in
/// which owners take kSharedSets sets in turn.
void find_neighbours(const WaveSurfaces& surfaces, const PixelPlace* pixel, Neighbours& neighbours);

/// The value of each surface becomes the mean of its neighbours' values by weight times `importance`; null: 1.
void share(const Neighbours& neighbours, const double* importance, double* values);

/// What the shadow rays of surfaces brought. Rows of one entry for each surface.
struct LightReceived {
  std::int64_t surfaces = 0;             ///< entries of a row
  const std::uint8_t* hidden = nullptr;  ///< a row for each light, 1 if a sphere hides the light; null: no shadows
  ColourRows share;                      ///< a row for each light, what arrives of one that is not hidden; none: all
  /// A row for each light with a radius, of LightShare; none: no shadows, or no light has a radius.
  ColourRows facing, seen;
  /// Of owners, if the picture has opacity and a plane that shows shadows alone: the plane gives its owner no light,
  /// and this share.
  double* coverage = nullptr;
};

/// light_of_shadows_only() (render/shading.h) of the surface with this number, which is on the plane. In a picture with
/// opacity it sets the owner's coverage instead.
Vec3d light_of_shadows_only(const WaveScene& scene, const WaveSurfaces& surfaces, std::int64_t number,
                            const LightReceived& received, const ColourRows& visibility);

/// Adds local_light() times weight and tint to the owners. `visibility`: of each surface; none: 1.
void add_local_light(const WaveScene& scene, const WaveSurfaces& surfaces, const LightReceived& received,
                     const ColourRows& visibility, WaveSums& sums);

/// Both steps at once for at least one primary ray, without secondary rays and without shadows: the light that
/// find_surfaces() and add_local_light() bring to the owners. The owners must have received nothing yet.
void shade_primaries(const WaveScene& scene, const WavePart& rays, const double* t, const std::int64_t* id,
                     WaveSums& sums);

/// reflected_ray() and transmitted_ray() of the surfaces from number `first` on, if the material has them, in the order
/// of the surfaces, the reflected one first. Appended to `next`, which must have room for two rays a surface.
struct SpawnedRays {
  std::int64_t reflected = 0, transmitted = 0;
};
SpawnedRays spawn_secondary_rays(const WaveScene& scene, const WaveSurfaces& surfaces, std::int64_t first, Wave& next);

/// toned() of the light of owners 0 to count - 1 that hit something: hit[owner] is not 0.
void tone_light(const Tone& tone, const std::uint8_t* hit, std::int64_t count, WaveSums& sums);

/// Rounds the light of owners 0 to count - 1 to binary32, and stores that of owner i in the film at pixel[i] -
/// film_corner. The pixels are those of order_pixels() from a multiple of 64 on.
void put_light(const WaveSums& sums, const PixelPlace* pixel, std::int64_t count, PixelPlace film_corner, Film& film);

}  // namespace steps

}  // namespace bihive
