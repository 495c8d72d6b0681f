// Rays against all images of a periodic set.
//
// A ray is followed in windows, in each of which it passes at most one cell along every vector. An image belongs to the
// window in which the ray enters its part of space: the spheres' shares (geometry/lattice.h), enlarged by the largest
// radius. So each image is looked at once, and when a hit lies before the next window, nothing nearer is left.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/bih/traversal.h"
#include "bihive/geometry/sphere.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "bihive/wide/tree/duplicates.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A ray that starts farther away than this, in cells, has no end for us: rounding would hide in which cell it is.
constexpr double kFarthestStart = 0x1p30;

constexpr double kMostOverlapping = 4096;

// The part of a vector at right angles to those along which the lattice extends.
Vec3d across(const Lattice& lattice, Vec3d vector) {
  Vec3d along[3];
  int count = 0;
  for (const ImageCounts& one : {ImageCounts{1, 0, 0}, ImageCounts{0, 1, 0}, ImageCounts{0, 0, 1}}) {
    Vec3d axis = lattice.shift(one);
    if (axis == Vec3d{}) continue;
    axis = axis / length(axis);
    for (int k = 0; k < count; ++k) axis = axis - dot(axis, along[k]) * along[k];
    along[count++] = axis / length(axis);
  }
  if (count == 3) return {};
  for (int k = 0; k < count; ++k) vector = vector - dot(vector, along[k]) * along[k];
  return vector;
}

// The excluded sphere of a ray, of which one image is skipped.
struct PassedOver {
  std::int64_t id = kNothing;
  std::int64_t in_tree = kNothing;  // the id under which the tree holds it: its own, or that of its pile
  std::int64_t twin = kNothing;     // the first other sphere of its pile
  Vec3d centre;                     // of the skipped image, in stored units

  PassedOver() = default;
  PassedOver(const WideTree& tree, std::int64_t sphere) {
    if (sphere < 0 || sphere >= tree.size) return;
    id = in_tree = sphere;
    for (const Pile& pile : tree.piles) {
      const auto others = tree.others_in_piles.begin();
      const auto first = others + static_cast<std::ptrdiff_t>(pile.first_other);
      const auto last = others + static_cast<std::ptrdiff_t>(pile.end_of_others);
      if (pile.id != sphere && std::find(first, last, sphere) == last) continue;
      in_tree = pile.id;
      twin = pile.id != sphere ? pile.id : *first;
    }
  }
};

struct AllHitsOfRay {
  std::int64_t ray;
  std::vector<RayHit>& hits;
  PassedOver passed_over;
  double t_of_passed_over = kInfinity;

  bool take(double t, std::int64_t id) const {
    if (t < limit()) hits.push_back({ray, t, id});
    return false;
  }
  // It is removed when those of its pile are known.
  bool take_passed_over(double t) {
    t_of_passed_over = t;
    return take(t, passed_over.in_tree);
  }
  static constexpr double limit() { return kInfinity; }
  static constexpr bool has_ended() { return false; }
  static constexpr bool kNeedsEnd = true;
};

template <bool kAnyHit>
struct NearestOfRay : NearestAnswer<kAnyHit> {
  PassedOver passed_over;

  bool take_passed_over(double t) { return passed_over.twin != kNothing && this->take(t, passed_over.twin); }
  bool has_ended() const { return kAnyHit && this->best.found(); }
  static constexpr bool kNeedsEnd = false;
};

// The spheres of one image.
template <class Answer>
struct ImageTest {
  const WideTree& tree;
  const ScaledRay& ray;
  Vec3d shift;
  Answer& answer;

  double limit() const { return answer.limit(); }
  bool operator()(std::int64_t slot) const {
    const Vec3d centre = tree.spheres.centre(slot) + shift;
    const std::int64_t id = tree.spheres.id(slot);
    const double t = sphere_hit(ray, centre, tree.spheres.radius(slot));
    const PassedOver& passed_over = answer.passed_over;
    if (id == passed_over.in_tree && centre == passed_over.centre) return answer.take_passed_over(t);
    return answer.take(t, id);
  }
};

}  // namespace

// Calls look_at(centre, radius) for the images of sphere `id` whose surfaces may be near the point, until it returns
// true; stored units.
template <class LookAt>
void PeriodicImages::each_image_near(Vec3d point, std::int64_t id, const LookAt& look_at) const {
  const auto i = static_cast<std::size_t>(id);
  const Vec3d own{double(x_[i]), double(y_[i]), double(z_[i])};
  const double radius = double(r_[i]);
  const Vec3d share = lattice_.shares(own);
  // From everywhere some image's centre is this near, and its surface at most as far.
  const double reach = 2 * (radius + lattice_.covering());
  const double largest = std::max(largest_coordinate(point), largest_);
  any_image(lattice_.images_within(reach, point, share, share, largest),
            [&](const ImageCounts& counts) { return look_at(own + lattice_.shift(counts), radius); });
}

// The centre of the image of sphere `id` whose surface is nearest to the point. Nothing: there is no such sphere.
std::optional<Vec3d> PeriodicImages::image_by_surface(Vec3d point, std::int64_t id) const {
  std::optional<Vec3d> found;
  if (id < 0 || id >= static_cast<std::int64_t>(x_.size())) return found;
  double nearest = kInfinity;
  each_image_near(point, id, [&](Vec3d centre, double radius) {
    const double distance = std::abs(length(point - centre) - radius);
    if (distance < nearest) {
      nearest = distance;
      found = centre;
    }
    return false;
  });
  return found;
}

std::optional<Vec3d> PeriodicImages::image_of_hit(const ScaledRay& ray, double t, std::int64_t id) const {
  std::optional<Vec3d> found;
  each_image_near(ray.origin + t * ray.direction, id, [&](Vec3d centre, double radius) {
    const SphereRoots roots = sphere_roots(ray, centre, radius);
    if (t == roots.t_near || t == roots.t_far) found = centre;
    return found.has_value();
  });
  return found;
}

// Clips the ray, across the lattice's directions, to the reach of the spheres.
Interval PeriodicImages::near_spheres(const ScaledRay& ray) const {
  Interval part{ray.t_min, ray.t_max};
  const Vec3d middle = 0.5 * (lo_ + hi_);
  const double reach =
      (length(hi_ - lo_) + largest_radius_) * (1 + 0x1p-20) + 0x1p-40 * (largest_coordinate(ray.origin) + largest_);
  const Vec3d from = across(lattice_, ray.origin - middle);
  const Vec3d by = across(lattice_, ray.direction);
  const double c = dot(from, from) - reach * reach;
  const double a = dot(by, by);
  if (a == 0) return c <= 0 ? part : Interval{kInfinity, 0};
  const double b = dot(from, by);
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return {kInfinity, 0};
  const double root = std::sqrt(discriminant);
  part.t_near = std::max(part.t_near, (-b - root) / a);
  part.t_far = std::min(part.t_far, (-b + root) / a);
  return part;
}

// The interval in which the ray may meet spheres of an image, in shares of the cell. It depends on the ray and the
// image alone. Its padding exceeds the rounding of shares, and is below half of that of Lattice::images_within(), which
// finds the images.
Interval PeriodicImages::in_image(const ScaledRay& ray, Vec3d share, Vec3d speed, const ImageCounts& counts) const {
  Interval part{-kInfinity, kInfinity};
  const double largest = largest_coordinate(ray.origin) + largest_;
  for (std::size_t k = 0; k < 3; ++k) {
    const double unit = lattice_.share_of_length(k);
    if (unit == 0) continue;
    const auto axis = static_cast<int>(k);
    const auto n = double(counts[k]);
    const double reach =
        largest_radius_ * unit + 0x1p-49 * lattice_.condition() * (1 + 4 * largest * unit + 4 * std::abs(n));
    const double lo = n + lowest_own_[axis] - reach - share[axis];
    const double hi = n + highest_own_[axis] + reach - share[axis];
    if (speed[axis] == 0) {
      if (lo > 0 || hi < 0) return {kInfinity, 0};
      continue;
    }
    const double one = lo / speed[axis];
    const double other = hi / speed[axis];
    part.t_near = std::max(part.t_near, std::min(one, other));
    part.t_far = std::min(part.t_far, std::max(one, other));
  }
  return part;
}

template <class Answer>
void PeriodicImages::trace_image(const WideTree& tree, const ScaledRay& ray, const ImageCounts& counts,
                                 Answer& answer) const {
  const Vec3d shift = lattice_.shift(counts);
  ScaledRay in_tree = ray;
  in_tree.origin = ray.origin - shift;
  const Slabs slabs(in_tree, 0x1p-46 * (largest_coordinate(ray.origin) + largest_coordinate(shift)));
  ImageTest<Answer> test{tree, ray, shift, answer};
  walk_leaves(tree, slabs, ray.t_min, ray.t_max, test);
}

// Returns whether the ray has an end. With `is_stored_known`, the answer has the spheres that are stored.
template <class Answer>
bool PeriodicImages::trace(const WideTree& tree, const Ray& ray, bool is_stored_known, Answer& answer) const {
  if (!is_valid(ray) || tree.node_count == 0) return true;
  ScaledRay scaled(ray, tree.scale);
  const Interval part = near_spheres(scaled);
  if (part.empty()) return true;
  const Vec3d share = lattice_.shares(scaled.origin);
  const Vec3d speed = lattice_.shares(scaled.direction);
  if (largest_coordinate(share) > kFarthestStart || part.t_near == -kInfinity) return false;
  if (const std::optional<Vec3d> left = image_by_surface(scaled.origin, ray.leaves)) {
    scaled.left_centre = *left;
    scaled.left_radius = double(r_[static_cast<std::size_t>(ray.leaves)]);
  }
  if (const std::optional<Vec3d> own = image_by_surface(scaled.origin, answer.passed_over.id))
    answer.passed_over.centre = *own;
  else
    answer.passed_over = {};

  // Windows along the ray.
  const double fastest = largest_coordinate(speed);
  const double step = fastest > 0 ? 1 / fastest : kInfinity;
  if (Answer::kNeedsEnd && !((part.t_far - part.t_near) / step <= kMostCells)) return false;
  struct Entry {
    double t;
    ImageCounts counts;
  };
  std::vector<Entry> entries;
  double begin = part.t_near;
  for (std::int64_t window = 0; window < kMostCells; ++window) {
    const double end = std::min(part.t_near + double(window + 1) * step, part.t_far);
    if (end == kInfinity) return false;
    const bool is_last = end == part.t_far;
    const Vec3d from = scaled.origin + begin * scaled.direction;
    const Vec3d to = scaled.origin + end * scaled.direction;
    const double largest =
        std::max({largest_coordinate(scaled.origin), largest_coordinate(from), largest_coordinate(to), largest_});
    entries.clear();
    any_image(lattice_.images_within(largest_radius_, from, to, lowest_own_, highest_own_, largest),
              [&](const ImageCounts& counts) {
                const Interval there = in_image(scaled, share, speed, counts);
                const bool is_here = (window == 0 || there.t_near >= begin) && (is_last || there.t_near < end);
                if (!there.empty() && is_here) entries.push_back({there.t_near, counts});
                return false;
              });
    // The nearer ones first, so that hits in them spare the others.
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.t < b.t; });
    for (const Entry& entry : entries) {
      if (entry.t > answer.limit()) break;
      if (is_stored_known && entry.counts == ImageCounts{}) continue;
      trace_image(tree, scaled, entry.counts, answer);
      if (answer.has_ended()) return true;
    }
    if (is_last || answer.limit() < end) return true;
    begin = end;
  }
  return false;
}

// The stored spheres are asked first, all rays at once. That does not help rays that leave a sphere: it may be an
// image's.

std::int64_t PeriodicImages::closest_hits(const WideTree& tree, const RaySpan& rays, const HitSpan& hits,
                                          const std::int64_t* exclude) const {
  bihive::closest_hits(tree, rays, RayOrder::any, hits);
  for (std::int64_t i = 0; i < rays.count; ++i) {
    stop_chunk_if_cancelled();
    const Ray ray = rays.at(i);
    NearestOfRay<false> nearest;
    if (exclude != nullptr) nearest.passed_over = PassedOver(tree, exclude[i]);
    const bool is_passed_over = hits.t[i] < kInfinity && hits.sphere_id[i] == nearest.passed_over.id;
    const bool is_known = ray.leaves < 0 && !is_passed_over;
    if (is_known) nearest.best = {hits.t[i], hits.sphere_id[i]};
    if (!trace(tree, ray, is_known, nearest)) return i;
    hits.t[i] = nearest.best.t;
    hits.sphere_id[i] = nearest.best.sphere_id;
  }
  return kNothing;
}

std::int64_t PeriodicImages::occluded(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden,
                                      const std::int64_t* exclude) const {
  bihive::occluded(tree, rays, RayOrder::any, hidden);
  for (std::int64_t i = 0; i < rays.count; ++i) {
    stop_chunk_if_cancelled();
    const Ray ray = rays.at(i);
    NearestOfRay<true> nearest;
    if (exclude != nullptr) nearest.passed_over = PassedOver(tree, exclude[i]);
    // What hides the ray may be the sphere that does not count.
    const bool is_known = ray.leaves < 0 && (hidden[i] == 0 || nearest.passed_over.id == kNothing);
    if (is_known && hidden[i] != 0) continue;
    if (!trace(tree, ray, is_known, nearest)) return i;
    hidden[i] = nearest.best.found() ? 1 : 0;
  }
  return kNothing;
}

std::int64_t PeriodicImages::all_hits(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits,
                                      const std::int64_t* exclude) const {
  hits.clear();
  for (std::int64_t i = 0; i < rays.count; ++i) {
    stop_chunk_if_cancelled();
    const std::size_t first = hits.size();
    AllHitsOfRay all{i, hits, {}};
    if (exclude != nullptr) all.passed_over = PassedOver(tree, exclude[i]);
    if (!trace(tree, rays.at(i), false, all)) return i;
    add_duplicates(tree, first, hits);
    if (all.t_of_passed_over < kInfinity)
      hits.erase(std::find_if(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(), [&](const RayHit& hit) {
        return hit.t == all.t_of_passed_over && hit.sphere_id == all.passed_over.id;
      }));
    std::sort(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
              [](const RayHit& a, const RayHit& b) { return a.t != b.t ? a.t < b.t : a.sphere_id < b.sphere_id; });
  }
  return kNothing;
}

Error PeriodicImages::ray_without_end(std::int64_t ray) {
  return {"ray " + std::to_string(ray) + " passes more than " + std::to_string(kMostCells) +
              " periodic cells without an end",
          "", 0, 0, "give it a smaller t_max, or make the tree without images"};
}

Status PeriodicImages::check_rays() const {
  const double images = lattice_.images_within(largest_radius_, {}, lowest_own_, highest_own_, largest_).count();
  if (images <= kMostOverlapping) return Done{};
  return Error{"the spheres extend over more than " + std::to_string(int(kMostOverlapping)) +
                   " periodic cells, too many for rays",
               "", 0, 0, "wrap them into the cell first, or make the tree without images"};
}

}  // namespace bihive
