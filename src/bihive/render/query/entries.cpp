#include "bihive/render/query/entries.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace bihive {
namespace {

constexpr double kFarthest = std::numeric_limits<double>::infinity();

// An interval of a line inside a body; -inf: the ray starts there.
struct Stay {
  double in, out;
  std::int64_t id;
  int its_class = 0;
};

// The stays that begin with a hit, or where the ray starts.
class Stays {
 public:
  Stays(const UnionOfBodies& bodies, const Ray& ray, std::vector<Stay>& found)
      : bodies_(bodies), ray_(ray), scaled_(ray, bodies.spheres->scale()), found_(found) {}

  void add(const RayHit& hit) {
    if (bodies_.cuts != nullptr && bodies_.cuts->is_cut(hit.sphere_id)) return add_cut(hit);
    const std::int64_t half = hit.sphere_id - bodies_.spheres->total_size();
    double near = 0, far = 0;
    if (half < 0) {
      const SphereRoots roots = sphere_roots(scaled_, bodies_.spheres->stored_centre(hit.sphere_id),
                                             bodies_.spheres->stored_radius(hit.sphere_id));
      near = roots.t_near;
      far = roots.t_far;
    } else {
      const StickRoots roots = stick_roots(scaled_, bodies_.sticks->stored(*bodies_.spheres, half / 2));
      near = roots.t_near;
      far = roots.t_far;
    }
    found_.push_back({hit.t == near ? near : -kFarthest, far, hit.sphere_id});
  }

 private:
  void add_cut(const RayHit& hit) {
    remaining_.clear();
    bodies_.cuts->find_remaining(ray_, hit.sphere_id, remaining_);
    for (const RemainingPart& part : remaining_)
      if (part.out >= hit.t) found_.push_back({part.in < hit.t ? -kFarthest : part.in, part.out, hit.sphere_id});
  }

  const UnionOfBodies& bodies_;
  const Ray& ray_;
  ScaledRay scaled_;
  std::vector<Stay>& found_;
  std::vector<RemainingPart> remaining_;
};

bool is_before(const Stay& a, const Stay& b) {
  if (a.its_class != b.its_class) return a.its_class < b.its_class;
  return a.in != b.in ? a.in < b.in : a.id < b.id;
}

// Unites the stays of one ray.
void add_entries(std::int64_t number, const Ray& ray, std::vector<Stay>& stays, std::vector<RayHit>& entries) {
  std::sort(stays.begin(), stays.end(), is_before);
  for (std::size_t i = 0; i < stays.size();) {
    const Stay& first = stays[i];
    Stay last = first;  // that ends last
    for (++i; i < stays.size() && stays[i].its_class == first.its_class && stays[i].in <= last.out; ++i)
      if (stays[i].out > last.out || (stays[i].out == last.out && stays[i].id < last.id)) last = stays[i];
    const bool starts_inside = first.in == -kFarthest;
    const double t = starts_inside ? last.out : first.in;
    if (t <= ray.t_max) entries.push_back({number, t, starts_inside ? last.id : first.id});
  }
}

}  // namespace

// Bodies may reach beyond the end of the segment, so rays go on there.
void UnionOfBodies::find_entries(const RaySpan& rays, RayOrder order, const std::function<int(std::int64_t)>& class_of,
                                 std::vector<RayHit>& entries) const {
  static thread_local std::vector<double> ends;
  static thread_local std::vector<RayHit> hits;
  static thread_local std::vector<Stay> stays;
  RaySpan on = rays;
  if (rays.t_max != nullptr) {
    ends.resize(static_cast<std::size_t>(rays.count));
    for (std::int64_t i = 0; i < rays.count; ++i)
      ends[static_cast<std::size_t>(i)] =
          rays.t_max[i] >= (rays.t_min != nullptr ? rays.t_min[i] : 0) ? kFarthest : rays.t_max[i];
    on.t_max = ends.data();
  }
  engine->all_hits(on, order, hits);
  entries.clear();
  for (std::size_t i = 0; i < hits.size();) {
    const std::int64_t number = hits[i].ray;
    const Ray ray = rays.at(number);
    stays.clear();
    Stays all(*this, ray, stays);
    for (; i < hits.size() && hits[i].ray == number; ++i) all.add(hits[i]);
    for (Stay& stay : stays) stay.its_class = class_of(stay.id);
    add_entries(number, ray, stays, entries);
  }
}

}  // namespace bihive
