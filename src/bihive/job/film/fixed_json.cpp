#include "bihive/job/film/fixed_json.h"

#include <cmath>
#include <stdexcept>

#include "bihive/scene/names.h"

namespace bihive {

using nlohmann::ordered_json;

ordered_json vector_json(Vec3d v) {
  return {v.x, v.y, v.z};
}

Vec3d vector_of(const ordered_json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

Vec3d point_of(const ordered_json& value) {
  constexpr double kMost = 3.4e38;
  const Vec3d point = vector_of(value);
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(point[axis]) <= kMost)) throw std::out_of_range("point");
  return point;
}

ordered_json range_json(const ColourRange& range) {
  return range ? ordered_json{range->first, range->second} : ordered_json();
}

ColourRange range_of(const ordered_json& value) {
  if (value.is_null()) return std::nullopt;
  const std::pair range{value.at(0).get<double>(), value.at(1).get<double>()};
  if (range.first > range.second) throw std::out_of_range("range");
  return range;
}

ordered_json camera_json(const Camera& camera) {
  return {{"eye", vector_json(camera.eye)},
          {"look_at", vector_json(camera.look_at)},
          {"up", vector_json(camera.up)},
          {"fov_deg", camera.fov_deg},
          {"projection", name_of(kProjections, camera.projection)},
          {"shorter_side", camera.shorter_side},
          {"aperture", camera.aperture},
          {"focus", camera.focus}};
}

Camera camera_of(const ordered_json& value) {
  Camera camera;
  camera.eye = vector_of(value.at("eye"));
  camera.look_at = vector_of(value.at("look_at"));
  camera.up = vector_of(value.at("up"));
  camera.fov_deg = value.at("fov_deg").get<double>();
  const auto projection = value_named(kProjections, value.at("projection").get<std::string>());
  if (!projection) throw std::out_of_range("projection");
  camera.projection = *projection;
  camera.shorter_side = value.at("shorter_side").get<double>();
  camera.aperture = value.at("aperture").get<double>();
  camera.focus = value.at("focus").get<double>();
  if (!check_camera(camera)) throw std::out_of_range("camera");
  return camera;
}

ordered_json motion_json(const RigidMotion& motion) {
  return {vector_json(motion.rows[0]), vector_json(motion.rows[1]), vector_json(motion.rows[2]),
          vector_json(motion.shift)};
}

RigidMotion motion_of(const ordered_json& value) {
  RigidMotion motion;
  for (std::size_t i = 0; i < 3; ++i) motion.rows[i] = point_of(value.at(i));
  motion.shift = point_of(value.at(3));
  return motion;
}

ordered_json plane_json(const Plane& plane) {
  return {{"point", vector_json(plane.point)}, {"normal", vector_json(plane.normal)}};
}

Plane plane_of(const ordered_json& value) {
  constexpr double kRounding = 1e-6;  // of a length of 1
  const Plane plane{point_of(value.at("point")), vector_of(value.at("normal"))};
  if (!(std::abs(length(plane.normal) - 1) < kRounding)) throw std::out_of_range("plane");
  return plane;
}

ordered_json density_json(const Density& density) {
  ordered_json json = ordered_json::object();
  if (density.radius) json["radius"] = *density.radius;
  if (density.opacity) json["opacity"] = *density.opacity;
  return json;
}

Density density_from(const ordered_json& value) {
  Density density;
  if (value.contains("radius")) density.radius = value.at("radius").get<double>();
  if (value.contains("opacity")) density.opacity = value.at("opacity").get<double>();
  if (density.radius && !(*density.radius >= 0 && std::isfinite(*density.radius))) throw std::out_of_range("radius");
  if (density.opacity && !(*density.opacity >= 0 && *density.opacity <= 1)) throw std::out_of_range("opacity");
  return density;
}

ordered_json fixed_json(const FixedByFilm& fixed) {
  ordered_json json{{"camera", camera_json(fixed.camera)},
                    {"range_of_style", range_json(fixed.range_of_style)},
                    {"ranges_of_looks", ordered_json::array()}};
  for (const ColourRange& range : fixed.ranges_of_looks) json["ranges_of_looks"].push_back(range_json(range));
  if (fixed.motion) json["motion"] = motion_json(*fixed.motion);
  if (fixed.floor) json["floor"] = plane_json(*fixed.floor);
  if (fixed.density) json["density"] = density_json(*fixed.density);
  if (fixed.fits_each) json["fits_each"] = true;
  return json;
}

FixedByFilm fixed_by_film_of(const ordered_json& value) {
  FixedByFilm fixed{camera_of(value.at("camera")), range_of(value.at("range_of_style")), {}};
  for (const ordered_json& range : value.at("ranges_of_looks")) fixed.ranges_of_looks.push_back(range_of(range));
  if (value.contains("motion")) fixed.motion = motion_of(value.at("motion"));
  if (value.contains("floor")) fixed.floor = plane_of(value.at("floor"));
  if (value.contains("density")) fixed.density = density_from(value.at("density"));
  fixed.fits_each = value.value("fits_each", false);
  return fixed;
}

}  // namespace bihive
