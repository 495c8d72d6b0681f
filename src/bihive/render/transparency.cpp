#include "bihive/render/transparency.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"

namespace bihive {
namespace {

// Spheres are equal if centre and radius are: a ray that leaves one of them leaves all (geometry/scaled_ray.h).
using Place = std::array<float, 4>;
Place place_of(const SphereSet& spheres, std::int64_t id) {
  const auto i = static_cast<std::size_t>(id);
  return {spheres.x()[i], spheres.y()[i], spheres.z()[i], spheres.r()[i]};
}

// Collects the crossings of one ray.
struct Crossings {
  const std::vector<std::int64_t>& ids;
  std::vector<Crossing>& found;

  bool take(double t, std::int64_t id) const {
    if (t < std::numeric_limits<double>::infinity()) found.push_back({t, ids[static_cast<std::size_t>(id)]});
    return false;
  }
  static double limit() { return std::numeric_limits<double>::infinity(); }
};

bool any_passes(const std::vector<double>& passing) {
  return std::any_of(passing.begin(), passing.end(), [](double share) { return share > 0; });
}

}  // namespace

Status TransparentSpheres::Part::make(const SphereSet& whole, Engine engine, int threads) {
  spheres = whole.part(ids);
  Result<Tracer> built = Tracer::build(spheres, engine, {}, threads);
  if (!built) return built.error();
  tracer.emplace(std::move(*built));

  // A ray may leave a sphere of the other part that has an equal here.
  std::vector<std::pair<Place, std::int64_t>> places;
  for (std::int64_t i = 0; i < spheres.size(); ++i) places.emplace_back(place_of(spheres, i), i);
  std::sort(places.begin(), places.end());
  own_place.resize(static_cast<std::size_t>(whole.size()), kNothing);
  for (std::int64_t id = 0; id < whole.size(); ++id) {
    const Place place = place_of(whole, id);
    const auto equal = std::lower_bound(places.begin(), places.end(), place,
                                        [](const auto& one, const Place& wanted) { return one.first < wanted; });
    if (equal != places.end() && equal->first == place) own_place[static_cast<std::size_t>(id)] = equal->second;
  }
  return Done{};
}

RaySpan TransparentSpheres::Part::rays_here(const RaySpan& rays, std::vector<std::int64_t>& leaves) const {
  RaySpan here = rays;
  if (rays.leaves == nullptr) return here;
  leaves.resize(static_cast<std::size_t>(rays.count));
  for (std::int64_t i = 0; i < rays.count; ++i) leaves[static_cast<std::size_t>(i)] = left_here(rays.leaves[i]);
  here.leaves = leaves.data();
  return here;
}

Result<std::shared_ptr<const TransparentSpheres>> TransparentSpheres::divide(const SphereSet& spheres,
                                                                             std::vector<double> passing, Engine engine,
                                                                             int threads) {
  try {
    // Tracers refer to the spheres of their part, so the object must not move.
    auto made = std::make_shared<TransparentSpheres>();
    made->passing_ = std::move(passing);
    for (std::int64_t id = 0; id < spheres.size(); ++id)
      (made->passing(id) > 0 ? made->transparent_ : made->opaque_).ids.push_back(id);
    for (Part* part : {&made->opaque_, &made->transparent_})
      if (Status status = part->make(spheres, engine, threads); !status) return status.error();
    made->tree_ = build_reference_tree(made->transparent_.spheres, TreeParameters().for_reference());
    return std::shared_ptr<const TransparentSpheres>(std::move(made));
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory for the transparent spheres", "", 0, 0, ""};
  }
}

Hit TransparentSpheres::closest_opaque(const Ray& ray) const {
  Ray here = ray;
  here.leaves = opaque_.left_here(ray.leaves);
  Hit hit = opaque_.tracer->closest_hit(here);
  if (hit.found()) hit.sphere_id = opaque_.ids[static_cast<std::size_t>(hit.sphere_id)];
  return hit;
}

void TransparentSpheres::find_crossings(const Ray& ray, std::vector<Crossing>& found) const {
  found.clear();
  if (!is_valid(ray)) return;
  Ray here = ray;
  here.leaves = transparent_.left_here(ray.leaves);
  Crossings crossings{transparent_.ids, found};
  NoObserver observer;
  walk(tree_, transparent_.spheres, ScaledRay(here, transparent_.spheres), crossings, observer);
  std::sort(found.begin(), found.end(),
            [](const Crossing& a, const Crossing& b) { return a.t != b.t ? a.t < b.t : a.id < b.id; });
}

double TransparentSpheres::share(const Ray& ray) const {
  Ray here = ray;
  here.leaves = opaque_.left_here(ray.leaves);
  if (opaque_.tracer->occluded(here)) return 0;
  static thread_local std::vector<Crossing> crossings;
  find_crossings(ray, crossings);
  double share = 1;
  for (const Crossing& crossing : crossings) share = share * passing(crossing.id);
  return share;
}

void TransparentSpheres::closest_opaque(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  static thread_local std::vector<std::int64_t> leaves;
  opaque_.tracer->closest_hits(opaque_.rays_here(rays, leaves), order, hits);
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (hits.sphere_id[i] >= 0) hits.sphere_id[i] = opaque_.ids[static_cast<std::size_t>(hits.sphere_id[i])];
}

void TransparentSpheres::hides(const RaySpan& rays, RayOrder order, std::uint8_t* hidden) const {
  static thread_local std::vector<std::int64_t> leaves;
  opaque_.tracer->occluded(opaque_.rays_here(rays, leaves), order, hidden);
}

void TransparentSpheres::find_crossings(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  if (const WideTree* tree = transparent_.tracer->wide_tree()) {
    // Most rays cross nothing, and that is quickly known. They get an end before their start.
    static thread_local std::vector<std::int64_t> leaves;
    static thread_local std::vector<std::uint8_t> crosses;
    static thread_local std::vector<double> ends;
    RaySpan here = transparent_.rays_here(rays, leaves);
    crosses.resize(static_cast<std::size_t>(rays.count));
    transparent_.tracer->occluded(here, order, crosses.data());
    ends.resize(static_cast<std::size_t>(rays.count));
    for (std::int64_t i = 0; i < rays.count; ++i) {
      const double end = rays.t_max != nullptr ? rays.t_max[i] : std::numeric_limits<double>::infinity();
      ends[static_cast<std::size_t>(i)] = crosses[static_cast<std::size_t>(i)] != 0 ? end : -1;
    }
    here.t_max = ends.data();
    all_hits(*tree, here, found);
    for (RayHit& hit : found) hit.sphere_id = transparent_.ids[static_cast<std::size_t>(hit.sphere_id)];
    return;
  }
  found.clear();
  std::vector<Crossing> of_ray;
  for (std::int64_t i = 0; i < rays.count; ++i) {
    find_crossings(rays.at(i), of_ray);
    for (const Crossing& crossing : of_ray) found.push_back({i, crossing.t, crossing.id});
  }
}

Result<Transparency> Transparency::of(const Scene& scene, OpacityRule rule, Engine engine, int threads) {
  Transparency parts;
  if (rule == OpacityRule::each_surface || !lets_light_through(scene)) return parts;
  const auto count = static_cast<std::size_t>(scene.spheres.size());
  std::vector<double> to_eye(count), to_light(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Material material = material_of(scene, static_cast<std::int64_t>(i));
    if (is_passed_straight(material)) to_eye[i] = std::min(material.transmissive, 1.0);
    to_light[i] = std::min(material.transmissive, 1.0);
  }

  const bool alike = to_eye == to_light;
  const auto divide = [&](std::vector<double>& passing) {
    return TransparentSpheres::divide(scene.spheres, std::move(passing), engine, threads);
  };
  if (any_passes(to_light)) {
    Result<std::shared_ptr<const TransparentSpheres>> divided = divide(to_light);
    if (!divided) return divided.error();
    parts.to_light = std::move(*divided);
  }
  if (alike) {
    parts.to_eye = parts.to_light;
  } else if (any_passes(to_eye)) {
    Result<std::shared_ptr<const TransparentSpheres>> divided = divide(to_eye);
    if (!divided) return divided.error();
    parts.to_eye = std::move(*divided);
  }
  return parts;
}

}  // namespace bihive
