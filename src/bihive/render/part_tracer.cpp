#include "bihive/render/part_tracer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/wide/queries.h"

namespace bihive {
namespace {

constexpr double kFarthestEnd = std::numeric_limits<double>::infinity();

// Spheres are equal if centre and radius are: a ray that leaves one of them leaves all (geometry/scaled_ray.h).
using Place = std::array<float, 4>;
Place place_in(const SphereSet& spheres, std::int64_t id) {
  const auto i = static_cast<std::size_t>(id);
  return {spheres.x()[i], spheres.y()[i], spheres.z()[i], spheres.r()[i]};
}

bool before(const Crossing& a, const Crossing& b) {
  return a.t != b.t ? a.t < b.t : a.id < b.id;
}

// Collects the hits of one ray on whole spheres.
struct AllWholeHits {
  const std::vector<std::int64_t>& ids;
  std::vector<Crossing>& found;

  bool take(double t, std::int64_t id) const {
    if (t < kFarthestEnd) found.push_back({t, ids[static_cast<std::size_t>(id)]});
    return false;
  }
  static double limit() { return kFarthestEnd; }
};

}  // namespace

// The hits of a ray on cut spheres: the closest one or any, or all of them. The t of the ball does not matter.
struct PartTracer::NearestCut {
  const CutSet& cuts;
  const std::vector<std::int64_t>& ids;
  bool any;
  Hit best;
  CutRay ray{ScaledRay({}, 1), false, {}, false};

  bool take(double, std::int64_t id) {
    const std::int64_t whole = ids[static_cast<std::size_t>(id)];
    best.keep_nearer(cuts.hit(ray, whole).t, whole);
    return any && best.found();
  }
  double limit() const { return best.t; }
};

struct PartTracer::AllCut {
  const CutSet& cuts;
  const std::vector<std::int64_t>& ids;
  std::vector<Crossing>& found;
  CutRay ray{ScaledRay({}, 1), false, {}, false};

  bool take(double, std::int64_t id) const {
    const std::int64_t whole = ids[static_cast<std::size_t>(id)];
    const double t = cuts.hit(ray, whole).t;
    if (t < kFarthestEnd) found.push_back({t, whole});
    return false;
  }
  static double limit() { return kFarthestEnd; }
};

Status PartTracer::Balls::make(const SphereSet& whole, const Parameters& parameters, bool with_tree) {
  spheres = whole.part(ids);
  Result<Tracer> built = Tracer::build(spheres, parameters.engine, parameters.tree, parameters.threads);
  if (!built) return built.error();
  tracer.emplace(std::move(*built));
  if (with_tree) tree = build_reference_tree(spheres, parameters.tree.for_reference());

  // A ray may leave a sphere elsewhere that has an equal here.
  for (std::int64_t i = 0; i < spheres.size(); ++i) by_place.push_back(i);
  std::sort(by_place.begin(), by_place.end(), [this](std::int64_t a, std::int64_t b) {
    const Place one = place_in(spheres, a);
    const Place other = place_in(spheres, b);
    return one != other ? one < other : a < b;
  });
  own_place.resize(static_cast<std::size_t>(whole.size()), kNothing);
  for (std::int64_t id = 0; id < whole.size(); ++id)
    own_place[static_cast<std::size_t>(id)] = place_of(whole.stored_centre(id), whole.stored_radius(id));
  return Done{};
}

std::int64_t PartTracer::Balls::place_of(Vec3d centre, double radius) const {
  const Vec3f at = to_float(centre);
  const Place wanted{at.x, at.y, at.z, static_cast<float>(radius)};
  const auto equal =
      std::lower_bound(by_place.begin(), by_place.end(), wanted,
                       [this](std::int64_t id, const Place& place) { return place_in(spheres, id) < place; });
  return equal != by_place.end() && place_in(spheres, *equal) == wanted ? *equal : kNothing;
}

Status PartTracer::make(const SphereSet& whole, std::shared_ptr<const CutSet> cuts,
                        const std::vector<std::int64_t>& ids, const Parameters& parameters) {
  cuts_ = std::move(cuts);
  for (const std::int64_t id : ids) {
    const Remainder remainder = cuts_ == nullptr ? Remainder::whole : cuts_->remainder(id);
    if (remainder == Remainder::whole) whole_.ids.push_back(id);
    if (remainder == Remainder::cut) cut_.ids.push_back(id);
  }
  try {
    if (Status status = whole_.make(whole, parameters, parameters.finds_all_hits); !status) return status;
    if (cut_.ids.empty()) return Done{};
    return cut_.make(whole, parameters, parameters.engine != Engine::brute);
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory for the parts of the set", "", 0, 0, ""};
  }
}

Ray PartTracer::ray_to(const Balls& balls, const Ray& ray) const {
  Ray here = ray;
  if (cuts_ == nullptr || !cuts_->is_cut(ray.leaves)) {
    const bool is_sphere = ray.leaves >= 0 && ray.leaves < static_cast<std::int64_t>(balls.own_place.size());
    here.leaves = is_sphere ? balls.own_place[static_cast<std::size_t>(ray.leaves)] : kNothing;
    return here;
  }
  const CutRay entered = cuts_->entering(ray);
  const bool leaves_round = entered.ray.left_radius >= 0;
  here.leaves = leaves_round ? balls.place_of(entered.ray.left_centre, entered.ray.left_radius) : kNothing;
  here.inside = entered.ray.inside;
  return here;
}

RaySpan PartTracer::rays_to(const Balls& balls, const RaySpan& rays, RayArrays& arrays) const {
  RaySpan here = rays;
  if (rays.leaves == nullptr) return here;
  const auto count = static_cast<std::size_t>(rays.count);
  arrays.leaves.resize(count);
  here.leaves = arrays.leaves.data();
  if (cuts_ != nullptr) {
    arrays.inside.resize(count);
    here.inside = arrays.inside.data();
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t leaves = rays.leaves[i];
    if (cuts_ == nullptr) {
      const bool is_sphere = leaves >= 0 && leaves < static_cast<std::int64_t>(balls.own_place.size());
      arrays.leaves[i] = is_sphere ? balls.own_place[static_cast<std::size_t>(leaves)] : kNothing;
      continue;
    }
    const Ray ray = ray_to(balls, rays.at(static_cast<std::int64_t>(i)));
    arrays.leaves[i] = ray.leaves;
    arrays.inside[i] = ray.inside ? 1 : 0;
  }
  return here;
}

template <class Answer>
void PartTracer::walk_cut(const Ray& ray, Answer& answer) const {
  if (cut_.ids.empty() || !is_valid(ray)) return;
  answer.ray = cuts_->entering(ray);
  if (cut_.tracer->engine() == Engine::brute) {
    for (std::int64_t id = 0; id < cut_.spheres.size(); ++id)
      if (answer.take(kFarthestEnd, id)) return;
    return;
  }
  NoObserver observer;
  walk(cut_.tree, cut_.spheres, answer.ray.ray, answer, observer);
}

Hit PartTracer::closest_hit(const Ray& ray) const {
  Hit hit = whole_.tracer->closest_hit(ray_to(whole_, ray));
  if (hit.found()) hit.sphere_id = whole_.whole_id(hit.sphere_id);
  if (cut_.ids.empty()) return hit;
  NearestCut nearest{*cuts_, cut_.ids, false, hit};
  walk_cut(ray, nearest);
  return nearest.best;
}

bool PartTracer::occluded(const Ray& ray) const {
  if (whole_.tracer->occluded(ray_to(whole_, ray))) return true;
  if (cut_.ids.empty()) return false;
  NearestCut nearest{*cuts_, cut_.ids, true, {}};
  walk_cut(ray, nearest);
  return nearest.best.found();
}

// A ray meets a cut sphere only if the line behind its start meets the ball, which many rays ask quickly. The end of
// the segment does not matter here: the whole segment may lie in the ball, and a cap in the segment.
template <class Use>
void PartTracer::for_each_near_cut(const RaySpan& rays, RayOrder order, const std::uint8_t* hidden,
                                   const Use& use) const {
  if (cut_.ids.empty()) return;
  static thread_local RayArrays arrays;
  const bool asks = cut_.tracer->engine() == Engine::wide;
  if (asks) {
    RaySpan here = rays_to(cut_, rays, arrays);
    here.t_max = nullptr;
    if (hidden != nullptr || rays.t_max != nullptr) {
      arrays.ends.resize(static_cast<std::size_t>(rays.count));
      for (std::int64_t i = 0; i < rays.count; ++i) {
        const double start = rays.t_min != nullptr ? rays.t_min[i] : 0;
        const bool skipped = (hidden != nullptr && hidden[i] != 0) || (rays.t_max != nullptr && rays.t_max[i] < start);
        arrays.ends[static_cast<std::size_t>(i)] = skipped ? -kFarthestEnd : kFarthestEnd;
      }
      here.t_max = arrays.ends.data();
    }
    arrays.near_cut.resize(static_cast<std::size_t>(rays.count));
    cut_.tracer->occluded(here, order, arrays.near_cut.data());
  }
  for (std::int64_t i = 0; i < rays.count; ++i) {
    if (hidden != nullptr && hidden[i] != 0) continue;
    if (!asks || arrays.near_cut[static_cast<std::size_t>(i)] != 0) use(i);
  }
}

void PartTracer::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  static thread_local RayArrays arrays;
  whole_.tracer->closest_hits(rays_to(whole_, rays, arrays), order, hits);
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (hits.sphere_id[i] >= 0) hits.sphere_id[i] = whole_.whole_id(hits.sphere_id[i]);
  for_each_near_cut(rays, order, nullptr, [&](std::int64_t i) {
    NearestCut nearest{*cuts_, cut_.ids, false, {hits.t[i], hits.sphere_id[i]}};
    walk_cut(rays.at(i), nearest);
    hits.t[i] = nearest.best.t;
    hits.sphere_id[i] = nearest.best.sphere_id;
  });
}

void PartTracer::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* hidden) const {
  static thread_local RayArrays arrays;
  whole_.tracer->occluded(rays_to(whole_, rays, arrays), order, hidden);
  for_each_near_cut(rays, order, hidden, [&](std::int64_t i) {
    NearestCut nearest{*cuts_, cut_.ids, true, {}};
    walk_cut(rays.at(i), nearest);
    if (nearest.best.found()) hidden[i] = 1;
  });
}

void PartTracer::all_hits(const Ray& ray, std::vector<Crossing>& found) const {
  found.clear();
  if (!is_valid(ray)) return;
  AllWholeHits all{whole_.ids, found};
  NoObserver observer;
  walk(whole_.tree, whole_.spheres, ScaledRay(ray_to(whole_, ray), whole_.spheres), all, observer);
  if (!cut_.ids.empty()) {
    AllCut all_cut{*cuts_, cut_.ids, found};
    walk_cut(ray, all_cut);
  }
  std::sort(found.begin(), found.end(), before);
}

void PartTracer::add_whole_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  // Most rays cross nothing, and that is quickly known. They get an end before their start.
  static thread_local RayArrays arrays;
  RaySpan here = rays_to(whole_, rays, arrays);
  arrays.near_cut.resize(static_cast<std::size_t>(rays.count));
  whole_.tracer->occluded(here, order, arrays.near_cut.data());
  arrays.ends.resize(static_cast<std::size_t>(rays.count));
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const double end = rays.t_max != nullptr ? rays.t_max[i] : kFarthestEnd;
    arrays.ends[static_cast<std::size_t>(i)] = arrays.near_cut[static_cast<std::size_t>(i)] != 0 ? end : -1;
  }
  here.t_max = arrays.ends.data();
  bihive::all_hits(*whole_.tracer->wide_tree(), here, found);
  for (RayHit& hit : found) hit.sphere_id = whole_.whole_id(hit.sphere_id);
}

void PartTracer::all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  std::vector<Crossing> of_ray;
  if (whole_.tracer->wide_tree() == nullptr) {
    found.clear();
    for (std::int64_t i = 0; i < rays.count; ++i) {
      all_hits(rays.at(i), of_ray);
      for (const Crossing& crossing : of_ray) found.push_back({i, crossing.t, crossing.id});
    }
    return;
  }
  add_whole_hits(rays, order, found);
  const std::size_t of_whole = found.size();
  for_each_near_cut(rays, order, nullptr, [&](std::int64_t i) {
    of_ray.clear();
    AllCut all_cut{*cuts_, cut_.ids, of_ray};
    walk_cut(rays.at(i), all_cut);
    for (const Crossing& crossing : of_ray) found.push_back({i, crossing.t, crossing.id});
  });
  if (found.size() == of_whole) return;
  std::sort(found.begin(), found.end(), [](const RayHit& a, const RayHit& b) {
    return a.ray != b.ray ? a.ray < b.ray : before({a.t, a.sphere_id}, {b.t, b.sphere_id});
  });
}

}  // namespace bihive
