#include "bihive/geometry/rounding_loss.h"

#include <cstring>

#include "bihive/base/readable.h"

namespace bihive {
namespace {

double number_at(const NumbersView& view, std::size_t i) {
  const char* const at = static_cast<const char*>(view.first) + static_cast<std::ptrdiff_t>(i) * view.step_bytes;
  if (view.precision == NumbersView::Precision::binary32) {
    float value;
    std::memcpy(&value, at, sizeof value);
    return double(value);
  }
  double value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

}  // namespace

RoundingLoss rounding_loss(const SphereSet& set, const NumbersView& x, const NumbersView& y, const NumbersView& z,
                           const NumbersView& r, std::int64_t first_id) {
  RoundingLoss loss;
  for (std::int64_t id = 0; id < set.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    const double radius = number_at(r, i);
    if (!(radius > 0)) continue;
    const Vec3d exact{number_at(x, i), number_at(y, i), number_at(z, i)};
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

}  // namespace bihive
