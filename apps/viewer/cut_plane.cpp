#include "cut_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/scene/camera.h"

namespace bihive::window {
namespace {

struct Plane {
  Vec3d normal;
  double distance = 0;  // n.x above it is removed
};

constexpr const char* kPrefix = "plane:";

std::optional<Plane> plane_of(const LookRows& rows) {
  const std::string text = rows.value("", "clip").value_or("");
  if (!text.starts_with(kPrefix)) return std::nullopt;
  const std::vector<double> numbers = numbers_from_text(text.substr(std::string(kPrefix).size()));
  if (numbers.size() != 4) return std::nullopt;
  return Plane{{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

void set_plane(LookRows& rows, const Plane& plane) {
  const auto& [normal, distance] = plane;
  rows.set("", "clip", fmt::format("{}{:.4g},{:.4g},{:.4g},{:.6g}", kPrefix, normal.x, normal.y, normal.z, distance));
}

// From the first to the last of the box's corners along a normal.
std::pair<double, double> range_of(const SphereSet::Bounds& bounds, Vec3d normal) {
  double low = 0, high = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = normal[axis] * bounds.lo[axis], b = normal[axis] * bounds.hi[axis];
    low += std::min(a, b);
    high += std::max(a, b);
  }
  return {low, high};
}

// The point of the plane nearest to the box's middle.
Vec3d middle_of(const SphereSet::Bounds& bounds, const Plane& plane) {
  const Vec3d middle = 0.5 * bounds.lo + 0.5 * bounds.hi;
  return middle + ((plane.distance - dot(plane.normal, middle)) / dot(plane.normal, plane.normal)) * plane.normal;
}

const std::array<std::pair<const char*, Vec3d>, 3> kAxes{
    {{"along x", {1, 0, 0}}, {"along y", {0, 1, 0}}, {"along z", {0, 0, 1}}}};

}  // namespace

const SphereSet::Bounds& CutPlane::bounds_of(const Viewer& viewer) {
  if (!bounds_) bounds_ = viewer.input_spheres().bounds();
  return *bounds_;
}

void CutPlane::draw(const Viewer& viewer, LookRows& rows) {
  const SphereSet::Bounds bounds = bounds_of(viewer);
  std::optional<Plane> plane = plane_of(rows);
  std::string side = plane ? "towards me" : "";
  std::vector<std::string> sides{"towards me"};
  for (const auto& [name, axis] : kAxes) {
    sides.emplace_back(name);
    if (plane && plane->normal == axis) side = name;
  }
  if (choice("Cut", "nothing", sides, side)) {
    if (side.empty()) return rows.set("", "clip", std::nullopt);
    const Camera& camera = viewer.settings().camera;
    Vec3d normal = (1 / length(camera.eye - camera.look_at)) * (camera.eye - camera.look_at);
    for (const auto& [name, axis] : kAxes)
      if (side == name) normal = axis;
    const auto [low, high] = range_of(bounds, normal);
    plane = Plane{normal, (low + high) / 2};
    set_plane(rows, *plane);
  }
  ImGui::BeginDisabled(!plane);
  label("Depth");
  const auto [low, high] = plane ? range_of(bounds, plane->normal) : std::pair(0.0, 1.0);
  auto percent = plane && high > low ? static_cast<float>(100 * (high - plane->distance) / (high - low)) : 0.0F;
  if (ImGui::SliderFloat("##depth", &percent, 0, 100, "%.0f %%", ImGuiSliderFlags_AlwaysClamp) && plane)
    set_plane(rows, {plane->normal, high - static_cast<double>(percent) / 100 * (high - low)});
  ImGui::EndDisabled();
  hint(
      "The handle over the picture moves the cut, too. By the CPU engine. A row with clip under Show cuts selected "
      "spheres.");
}

void CutPlane::draw_handle(const Viewer& viewer, LookRows& rows, ImVec2 picture_px, float per_unit, Covered& covered) {
  const std::optional<Plane> plane = plane_of(rows);
  if (!plane) return;
  const SphereSet::Bounds bounds = bounds_of(viewer);
  const PixelPlaces places(viewer.settings().camera, static_cast<int>(picture_px.x), static_cast<int>(picture_px.y));
  const auto seen = [&](Vec3d world) -> std::optional<ImVec2> {
    const Vec3d point = places.from_eye(world);
    if (point.z <= 0) return std::nullopt;
    return ImVec2(static_cast<float>(places.x_px(point)) / per_unit, static_cast<float>(places.y_px(point)) / per_unit);
  };
  const Vec3d middle = middle_of(bounds, *plane);
  const auto [low, high] = range_of(bounds, plane->normal);
  const double step = (high - low) / 10;
  const std::optional<ImVec2> here = seen(middle);
  const std::optional<ImVec2> there = seen(middle + (step / dot(plane->normal, plane->normal)) * plane->normal);
  if (!here) return;
  const float radius = 0.8F * ImGui::GetFontSize();
  ImGui::SetNextWindowPos({here->x - radius, here->y - radius});
  ImGui::SetNextWindowSize({2 * radius, 2 * radius});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("cut", nullptr, kOverlay | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoBringToFrontOnFocus);
  covered.add_window();
  ImGui::InvisibleButton("handle", {2 * radius, 2 * radius});
  const bool held = ImGui::IsItemActive();
  ImGui::GetWindowDrawList()->AddCircleFilled(*here, radius * 0.9F, ImGui::GetColorU32(kAccent));
  ImGui::GetWindowDrawList()->AddCircle(*here, radius * 0.9F, ImGui::GetColorU32(ImGuiCol_Text), 0, radius / 6);
  ImGui::End();
  ImGui::PopStyleVar(2);
  if (!held) return taken_.reset();
  if (!taken_) {
    taken_ = plane->distance;
    moved_ = 0;
  }
  // A plane that faces the eye goes away as the hand goes down.
  const ImVec2 drag = ImGui::GetIO().MouseDelta;
  if (drag.x == 0 && drag.y == 0) return;
  const ImVec2 along = there ? ImVec2(there->x - here->x, there->y - here->y) : ImVec2(0, 0);
  const float length_of_step = std::hypot(along.x, along.y);
  constexpr float kLeastPx = 4;
  const float steps = length_of_step > kLeastPx
                          ? (drag.x * along.x + drag.y * along.y) / (length_of_step * length_of_step)
                          : -drag.y / (picture_px.y / per_unit / 20);
  moved_ += static_cast<double>(steps) * step;
  set_plane(rows, {plane->normal, std::clamp(*taken_ + moved_, low, high)});
}

}  // namespace bihive::window
