#include "bihive/scene/arrows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/scene/stick_colours.h"
#include "bihive/select/number_term.h"
#include "bihive/select/selection.h"

namespace bihive {
namespace {

using Components = std::array<FoundAttribute, 3>;

Result<Components> components_of(const SphereSet& spheres, const std::string& text) {
  Components found;
  std::string_view rest = text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    if (name.empty() || (comma == std::string_view::npos) != (axis == 2))
      return Error{setting_name("arrows") + ": expected three attributes VX,VY,VZ, found \"" + text + "\"", "", 0, 0,
                   suggestion("", attribute_names(spheres))};
    Result<FoundAttribute> one = find_numbers(spheres, name);
    if (!one) return error_of_setting("arrows", one.error());
    if (!one->has_numbers())
      return Error{setting_name("arrows") + ": \"" + std::string(name) + "\" holds texts, and a vector needs numbers",
                   "", 0, 0, ""};
    found[axis] = std::move(*one);
    if (comma != std::string_view::npos) rest.remove_prefix(comma + 1);
  }
  return found;
}

Vec3d vector_at(const Components& components, const SphereSet& spheres, std::int64_t id) {
  Vec3d vector;
  for (int axis = 0; axis < 3; ++axis) vector[axis] = components[static_cast<std::size_t>(axis)].number_of(spheres, id);
  return vector;
}

// The scale at which the longest finite vector has a share of the set's longest side.
double scale_by_share(const Components& components, const SphereSet& spheres, const std::vector<std::uint8_t>& mask,
                      double share) {
  double longest = 0;
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    if (const double extent = length(vector_at(components, spheres, id));
        mask[static_cast<std::size_t>(id)] != 0 && std::isfinite(extent))
      longest = std::max(longest, extent);
  const SphereSet::Bounds bounds = spheres.bounds();
  const Vec3d sides = bounds.hi - bounds.lo;
  return longest > 0 ? share * std::max({sides.x, sides.y, sides.z}) / longest : 1;
}

// `shaft`: its radius.
void add_arrow(Vec3d tail, Vec3d vector, double shaft, OwnStick like, std::vector<OwnStick>& sticks) {
  const double long_head = kArrowHeadLength * shaft, extent = length(vector);
  const Vec3d tip = tail + vector;
  const double head = std::min(long_head, extent);
  const Vec3d neck = head < extent ? tip - (head / extent) * vector : tail;
  if (head < extent) {
    like.a = tail;
    like.b = neck;
    like.radius_a = like.radius_b = shaft;
    sticks.push_back(like);
  }
  like.a = neck;
  like.b = tip;
  like.radius_a = kArrowHeadRadius * shaft * (head / long_head);
  like.radius_b = 0;
  sticks.push_back(like);
}

}  // namespace

Result<AddedArrows> add_arrows(Scene& scene, const Arrows& arrows) {
  SphereSet& spheres = scene.spheres;
  const Result<Components> components = components_of(spheres, arrows.components);
  if (!components) return components.error();
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(spheres.size()), 1);
  if (!arrows.select.empty()) {
    Result<std::vector<std::uint8_t>> selected = select_spheres(spheres, arrows.select);
    if (!selected) return error_of_setting("arrow_select", selected.error());
    mask = std::move(*selected);
  }
  std::optional<ColourBy> how;
  const Result<std::vector<Vec3f>> colours = stick_colours(spheres, scene, "arrow_colour", arrows.colour, mask, how);
  if (!colours) return colours.error();

  AddedArrows added;
  std::vector<OwnStick> sticks;
  const double scale = arrows.share > 0 ? scale_by_share(*components, spheres, mask, arrows.share) : arrows.scale;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    if (mask[i] == 0) continue;
    const Vec3d vector = scale * vector_at(*components, spheres, id);
    const double extent = length(vector);
    if (!std::isfinite(extent)) ++added.unknown;
    if (!std::isfinite(extent) || extent == 0) continue;
    const double of_sphere = spheres.radius(id);
    if (std::isinf(arrows.radius) && of_sphere == 0)
      return Error{setting_name("arrows") + ": sphere " + std::to_string(input_id(scene, id)) +
                       " has radius 0, and the shaft of an arrow is a quarter of its sphere's radius",
                   "", 0, 0, "state the radius of all shafts: " + setting_name("arrow_radius") + " R"};
    OwnStick like;
    like.sphere = static_cast<std::int32_t>(id);
    if (!colours->empty()) like.colour = (*colours)[i];
    const Vec3d centre = spheres.local_centre(id);
    const bool by_tail = arrows.pivot == ArrowPivot::tail;
    add_arrow(by_tail ? centre : centre - 0.5 * vector, vector,
              std::isinf(arrows.radius) ? 0.25 * of_sphere : arrows.radius, like, sticks);
    ++added.count;
    if ((by_tail ? extent : 0.5 * extent) <= of_sphere) ++added.inside;
    if (extent > added.longest) {
      added.longest = extent;
      added.radius_of_longest = of_sphere;
    }
  }
  if (Status status = scene.sticks.add(spheres, sticks); !status) return error_of_setting("arrows", status.error());
  if (Status status = check_sticks(scene); !status) return status.error();
  if (added.count > 0 && how) scene.sticks_coloured_by.push_back(std::move(*how));
  return added;
}

}  // namespace bihive
