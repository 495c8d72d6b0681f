// Values that a film fixes for its pictures, as JSON: in the description of a film and in the record of a picture.
// Functions that read throw std::out_of_range, or as nlohmann::json, on values that no film has.
#pragma once

#include <nlohmann/json.hpp>

#include "bihive/job/picture_request.h"

namespace bihive {

nlohmann::ordered_json vector_json(Vec3d v);
Vec3d vector_of(const nlohmann::ordered_json& value);
/// With coordinates that a sphere's centre may have.
Vec3d point_of(const nlohmann::ordered_json& value);

nlohmann::ordered_json range_json(const ColourRange& range);
ColourRange range_of(const nlohmann::ordered_json& value);

/// To the last bit.
nlohmann::ordered_json camera_json(const Camera& camera);
Camera camera_of(const nlohmann::ordered_json& value);

nlohmann::ordered_json motion_json(const RigidMotion& motion);
RigidMotion motion_of(const nlohmann::ordered_json& value);

nlohmann::ordered_json plane_json(const Plane& plane);
/// Its normal has length 1.
Plane plane_of(const nlohmann::ordered_json& value);

nlohmann::ordered_json density_json(const Density& density);
Density density_from(const nlohmann::ordered_json& value);

nlohmann::ordered_json fixed_json(const FixedByFilm& fixed);
FixedByFilm fixed_by_film_of(const nlohmann::ordered_json& value);

}  // namespace bihive
