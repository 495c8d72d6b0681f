#include "bihive/scene/clips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/geometry/cut_sphere.h"

namespace bihive {
namespace {

constexpr const char* kForms = "plane:NX,NY,NZ,D, box:X0,Y0,Z0,X1,Y1,Z1 or sphere:X,Y,Z,R";

Error clip_error(const std::string& message) {
  return {message, "", 0, 0, ""};
}

bool in_range(double value) {
  return std::abs(value) <= double{std::numeric_limits<float>::max()};
}
bool in_range(Vec3d v) {
  return in_range(v.x) && in_range(v.y) && in_range(v.z);
}

// Parses as many numbers as the array has, separated by commas.
template <std::size_t kCount>
Result<std::array<double, kCount>> numbers(std::string_view text, const std::string& form) {
  const std::vector<std::string_view> parts = parts_of(text, ',');
  if (parts.size() != kCount) return unexpected(std::to_string(kCount) + " numbers as " + form, text);
  std::array<double, kCount> values{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::optional<double> number = parse_double(parts[i]);
    if (!number || !in_range(*number)) return unexpected("a number between -3.4e38 and 3.4e38 in " + form, parts[i]);
    values[i] = *number;
  }
  return values;
}

Result<Clip> checked(const Clip& clip) {
  if (Status status = check_clip(clip); !status) return status.error();
  return clip;
}

Result<Clip> plane_from(std::string_view text) {
  const auto n = numbers<4>(text, "plane:NX,NY,NZ,D");
  if (!n) return n.error();
  return checked(PlaneClip{{(*n)[0], (*n)[1], (*n)[2]}, (*n)[3]});
}

Result<Clip> box_from(std::string_view text) {
  const auto n = numbers<6>(text, "box:X0,Y0,Z0,X1,Y1,Z1");
  if (!n) return n.error();
  BoxClip box;
  for (int axis = 0; axis < 3; ++axis) {
    const double one = (*n)[static_cast<std::size_t>(axis)];
    const double other = (*n)[static_cast<std::size_t>(axis) + 3];
    box.lo[axis] = std::min(one, other);
    box.hi[axis] = std::max(one, other);
  }
  return checked(box);
}

Result<Clip> sphere_from(std::string_view text) {
  const auto n = numbers<4>(text, "sphere:X,Y,Z,R");
  if (!n) return n.error();
  return checked(SphereClip{{(*n)[0], (*n)[1], (*n)[2]}, (*n)[3]});
}

Status check(const PlaneClip& plane) {
  if (!in_range(plane.normal) || !in_range(plane.offset)) return clip_error("a number of the clip is beyond 3.4e38");
  if (plane.normal == Vec3d{}) return clip_error("the normal of the plane must not be 0,0,0");
  return Done{};
}

Status check(const BoxClip& box) {
  if (!in_range(box.lo) || !in_range(box.hi)) return clip_error("a number of the clip is beyond 3.4e38");
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.lo[axis] < box.hi[axis]))
      return clip_error("the box must be larger than 0 along x, y and z, and is not along " +
                        std::string(1, "xyz"[axis]));
  return Done{};
}

Status check(const SphereClip& sphere) {
  if (!in_range(sphere.centre) || !in_range(sphere.radius)) return clip_error("a number of the clip is beyond 3.4e38");
  if (!(sphere.radius > 0)) return clip_error("the radius of the sphere must be above 0");
  return Done{};
}

}  // namespace

Result<Clip> clip_from_text(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view kind = std::string_view(text).substr(0, colon);
  const std::string_view rest =
      colon == std::string::npos ? std::string_view() : std::string_view(text).substr(colon + 1);
  if (kind == "plane") return plane_from(rest);
  if (kind == "box") return box_from(rest);
  if (kind == "sphere") return sphere_from(rest);
  return unexpected(kForms, text);
}

Status check_clip(const Clip& clip) {
  return std::visit([](const auto& shape) { return check(shape); }, clip);
}

bool has_clips(const Scene& scene) {
  const std::vector<std::uint64_t>& of_spheres = scene.spheres.attributes().clips;
  return !scene.clips.empty() &&
         std::any_of(of_spheres.begin(), of_spheres.end(), [](std::uint64_t mask) { return mask != 0; });
}

std::shared_ptr<const CutSet> cut_set_of(const Scene& scene) {
  if (!has_clips(scene)) return nullptr;
  auto cuts = std::make_shared<const CutSet>(scene.spheres, scene.clips, scene.spheres.attributes().clips,
                                             scene.sticks.empty() ? nullptr : &scene.sticks);
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id)
    if (cuts->remainder(id) != Remainder::whole) return cuts;
  for (std::int64_t stick = 0; stick < scene.sticks.size(); ++stick)
    if (cuts->remainder_of_stick(stick) != Remainder::whole) return cuts;
  return nullptr;
}

std::vector<std::int64_t> remaining_ids(const Scene& scene, const std::vector<std::int64_t>& ids) {
  const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  if (cuts == nullptr) return ids;
  std::vector<std::int64_t> remaining;
  for (const std::int64_t id : ids)
    if (cuts->remainder(id) != Remainder::nothing) remaining.push_back(id);
  return remaining;
}

RemainingSpheres::RemainingSpheres(const Scene& scene) : whole_(&scene.spheres) {
  const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  if (cuts == nullptr) return;
  std::vector<std::int64_t> ids;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id)
    if (cuts->remainder(id) != Remainder::nothing) ids.push_back(id);
  if (static_cast<std::int64_t>(ids.size()) < scene.spheres.size()) part_ = scene.spheres.part(ids);
}

}  // namespace bihive
