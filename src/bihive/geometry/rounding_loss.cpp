#include "bihive/geometry/rounding_loss.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/readable.h"

namespace bihive {

RoundingLoss rounding_loss(const SphereSet& set, const NumbersView& x, const NumbersView& y, const NumbersView& z,
                           const NumbersView& r, std::int64_t first_id) {
  RoundingLoss loss;
  for (std::int64_t id = 0; id < set.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    const double radius = r.at(i);
    if (!(radius > 0)) continue;
    const Vec3d exact{x.at(i), y.at(i), z.at(i)};
    const double share = length(set.local_centre(id) - set.to_local(exact)) / radius;
    if (!(share > SphereSet::kHarmlessShift)) continue;
    ++loss.moved;
    if (share > loss.worst_share) {
      loss.worst_share = share;
      loss.worst_id = first_id + id;
    }
  }
  loss.vanishing = set.vanishing_radii();
  return loss;
}

std::string rounding_warning(const RoundingLoss& loss, std::int64_t all) {
  if (loss.moved == 0) return "";
  return "rounding to single precision moves " + std::to_string(loss.moved) + " of " + std::to_string(all) +
         " centres by more than 1 % of the radius (sphere " + std::to_string(loss.worst_id) + " by " +
         readable_number(100 * loss.worst_share) + " %); the radii are too small for the extent";
}

bool needs_all_digits(const SphereSet& spheres) {
  if (spheres.has_origin()) return true;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d c = spheres.centre(id);
    const double rounding = 0x1p-24 * std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    const double radius = spheres.radius(id);
    if (radius > 0 && rounding > SphereSet::kHarmlessShift / 2 * radius) return true;
  }
  return false;
}

}  // namespace bihive
