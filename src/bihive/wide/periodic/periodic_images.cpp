#include "bihive/wide/periodic_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "bihive/base/watch.h"
#include "bihive/geometry/sphere_distance.h"
#include "bihive/wide/trace/points.h"
#include "bihive/wide/wide_builder.h"

namespace bihive {
namespace {

// A set that extends farther than this, in cells, is brought into one.
constexpr double kMostExtent = 2;

}  // namespace

// A point, the tree in which its neighbours are looked up, and the image of the point in that tree's cell.
struct PeriodicImages::Place {
  const wide::PointQuestion& question;
  const WideTree& tree;
  ImageCounts cell;
  Vec3d in_cell;   // stored units of the set
  double largest;  // of its coordinates and those of the spheres
  Vec3d point;     // the question's to the tree, and their shifts, in its units
  double units;
  bool moves_spheres;
  bool is_far;  // it knows no images

  wide::PointQuestion to_tree(const Lattice& lattice, const ImageCounts& counts, double limit) const {
    const Vec3d shift = lattice.shift(moves_spheres ? counts : counts + cell);
    return {point, limit * units, question.to, question.mask, shift * units};
  }
};

Result<std::optional<PeriodicImages>> PeriodicImages::of(const SphereSet& spheres, int threads) {
  const std::optional<Lattice> lattice = Lattice::of(spheres.cell());
  if (!lattice || spheres.empty()) return std::optional<PeriodicImages>();
  PeriodicImages made(lattice->times(spheres.scale()));
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    if (!made.lattice_.holds(spheres.stored_centre(id))) return std::optional<PeriodicImages>();
  const auto take_shares = [&made](const auto& centre_of, std::int64_t count) {
    for (std::int64_t id = 0; id < count; ++id) {
      const Vec3d share = made.lattice_.shares(centre_of(id));
      for (int axis = 0; axis < 3; ++axis) {
        made.lowest_share_[axis] = id == 0 ? share[axis] : std::min(made.lowest_share_[axis], share[axis]);
        made.highest_share_[axis] = id == 0 ? share[axis] : std::max(made.highest_share_[axis], share[axis]);
      }
    }
  };
  made.lo_ = made.hi_ = spheres.stored_centre(0);
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d centre = spheres.stored_centre(id);
    made.largest_ = std::max(made.largest_, largest_coordinate(centre));
    made.largest_radius_ = std::max(made.largest_radius_, spheres.stored_radius(id));
    for (int axis = 0; axis < 3; ++axis) {
      made.lo_[axis] = std::min(made.lo_[axis], centre[axis]);
      made.hi_[axis] = std::max(made.hi_[axis], centre[axis]);
    }
  }
  take_shares([&](std::int64_t id) { return spheres.stored_centre(id); }, spheres.size());
  made.lowest_own_ = made.lowest_share_;
  made.highest_own_ = made.highest_share_;
  try {
    made.x_ = spheres.x();
    made.y_ = spheres.y();
    made.z_ = spheres.z();
    made.r_ = spheres.r();
    const Vec3d extent = made.highest_share_ - made.lowest_share_;
    if (std::max({extent.x, extent.y, extent.z}) <= kMostExtent) return std::optional<PeriodicImages>(std::move(made));

    const auto count = static_cast<std::size_t>(spheres.size());
    std::vector<double> x(count), y(count), z(count), r(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d centre = spheres.stored_centre(static_cast<std::int64_t>(i));
      const Vec3d moved = centre - made.lattice_.shift(made.lattice_.cell_of(centre));
      x[i] = moved.x, y[i] = moved.y, z[i] = moved.z;
      r[i] = spheres.stored_radius(static_cast<std::int64_t>(i));
    }
    const Result<SphereSet> in_cell = SphereSet::from_world(x, y, z, r);
    if (!in_cell) return in_cell.error();
    take_shares([&](std::int64_t id) { return in_cell->centre(id); }, in_cell->size());
    WideBuilder builder;
    const auto tree = builder.build(*in_cell, {}, threads);
    if (!tree) return tree.error();
    made.in_cell_ = *tree;
    return std::optional<PeriodicImages>(std::move(made));
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory for the images of a periodic cell", "", 0, 0, ""};
  }
}

PeriodicImages::Place PeriodicImages::place_of(const WideTree& tree, const wide::PointQuestion& question) const {
  // In the cell that begins where the spheres do.
  const Vec3d point = question.point;
  const bool is_far = !lattice_.holds(point);
  const Vec3d share = lattice_.shares(point);
  ImageCounts cell = is_far ? ImageCounts{} : lattice_.cell_of(point);
  for (std::size_t k = 0; k < 3 && !is_far; ++k) {
    const auto axis = static_cast<int>(k);
    cell[k] += static_cast<std::int64_t>(std::floor(share[axis] - double(cell[k]) - lowest_share_[axis]));
  }
  const Vec3d in_cell = point - lattice_.shift(cell);
  const double largest = std::max(largest_coordinate(point), largest_);
  if (!in_cell_) return {question, tree, cell, in_cell, largest, point, 1, false, is_far};
  return {question, *in_cell_, cell, in_cell, largest, in_cell * in_cell_->scale, in_cell_->scale, true, is_far};
}

// Moving into the cell and back rounds coordinates and shifts, each some times; a share of a skewed cell may be
// condition() times as long as the sum of all. A tree of moved spheres rounds them to binary32.
double PeriodicImages::rounding(const Place& place, double reach) const {
  if (!place.moves_spheres) return 0;
  return 0x1p-46 * lattice_.condition() * (place.largest + reach + lattice_.longest()) + 0x1p-22 / place.units;
}

Lattice::Range PeriodicImages::range_of(const Place& place, double limit) const {
  const double reach = limit + (place.question.to == DistanceTo::surface ? largest_radius_ : 0);
  if (!(reach >= 0)) return {{0, 0, 0}, {-1, 0, 0}};
  if (place.is_far) return {};
  return lattice_.images_within(reach, place.in_cell, lowest_share_, highest_share_, place.largest);
}

double PeriodicImages::images_within(double limit) const {
  const double reach = std::max(limit, 0.0) + largest_radius_;
  return lattice_.images_within(reach, {}, lowest_share_, highest_share_, largest_).count();
}

void PeriodicImages::find_within(const WideTree& tree, const wide::PointQuestion& question,
                                 std::vector<wide::NearSphere>& found) const {
  const Place place = place_of(tree, question);
  const double pad = rounding(place, std::abs(question.limit) + largest_radius_);
  any_image(range_of(place, question.limit + pad), [&](const ImageCounts& counts) {
    stop_chunk_if_cancelled();
    const std::size_t known = found.size();
    wide::find_within(place.tree, place.to_tree(lattice_, counts, question.limit + pad), found);
    if (!place.moves_spheres) return false;
    // The distance from where the sphere was read decides.
    std::size_t kept = known;
    for (std::size_t i = known; i < found.size(); ++i) {
      const std::int64_t id = found[i].id;
      const auto at = static_cast<std::size_t>(id);
      const Vec3d centre{double(x_[at]), double(y_[at]), double(z_[at])};
      const Vec3d shift = lattice_.shift(counts + place.cell - lattice_.cell_of(centre));
      const double distance = image_distance(question.point, centre, shift, double(r_[at]), question.to);
      if (distance <= question.limit) found[kept++] = {distance, id};
    }
    found.resize(kept);
    return false;
  });
}

std::int64_t PeriodicImages::nearest_of(const Place& place, double within, std::int64_t wanted,
                                        wide::NearSphere* nearest) const {
  double limit = within;
  std::int64_t most = wanted;
  const auto in_units = [&](double distance) { return distance / place.units; };
  std::int64_t count = 0;
  const auto look_at = [&](const ImageCounts& counts) {
    stop_chunk_if_cancelled();
    count = wide::find_nearest(place.tree, place.to_tree(lattice_, counts, limit), most, nearest, count);
    return false;
  };
  // The image that is most likely the nearest; then those that may be nearer than what it has.
  look_at({});
  if (place.is_far) return count;
  if (count == most) {
    const double reach = std::min(limit, in_units(nearest[most - 1].distance));
    any_image(range_of(place, reach + rounding(place, reach)),
              [&](const ImageCounts& counts) { return counts != ImageCounts{} && look_at(counts); });
    return count;
  }
  // There, fewer spheres than are wanted: their images, farther and farther away, unless no sphere counts at all.
  if (count == 0) {
    limit = std::numeric_limits<double>::infinity();
    most = 1;
    look_at({});
    most = wanted;
    if (count == 0) return 0;
  }
  for (double reach = in_units(std::abs(nearest[count - 1].distance)) + lattice_.longest();; reach *= 2) {
    limit = std::min(reach, within);
    count = 0;
    any_image(range_of(place, limit + rounding(place, limit)), look_at);
    if (count == wanted || limit == within) return count;
  }
}

std::int64_t PeriodicImages::find_nearest(const WideTree& tree, const wide::PointQuestion& question, std::int64_t most,
                                          wide::NearSphere* nearest) const {
  const Place place = place_of(tree, question);
  const double pad = rounding(place, largest_radius_);
  const std::int64_t count = nearest_of(place, question.limit + pad, most, nearest);
  if (!place.moves_spheres || count == 0) return count;
  // All that may be among them by their rounded distances, in order of their own.
  double limit = question.limit;
  if (count == most) {
    const double farthest = nearest[most - 1].distance / place.units;
    limit = std::min(limit, farthest + 2 * rounding(place, std::abs(farthest) + largest_radius_));
  }
  std::vector<wide::NearSphere> found;
  find_within(tree, {question.point, limit, question.to, question.mask}, found);
  std::sort(found.begin(), found.end());
  const auto kept = std::min(most, static_cast<std::int64_t>(found.size()));
  std::copy(found.begin(), found.begin() + kept, nearest);
  return kept;
}

}  // namespace bihive
