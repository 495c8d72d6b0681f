#include "bihive/render/query/part_tracer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <new>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/render/query/image_tracer.h"
#include "bihive/wide/queries.h"

namespace bihive {
namespace {

// Groups of cut spheres, and spheres of a leaf of their trees: a test of a cut sphere costs more than that of a box.
constexpr std::size_t kMostGroups = 8;
constexpr std::int64_t kPrimsOfCut = 2;

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

// The hits of a ray on cut spheres: the closest one or any, or all of them.
struct PartTracer::NearestCut {
  const CutSet& cuts;
  bool any;
  Hit best;
  const std::vector<std::int64_t>* ids = nullptr;
  CutRay ray{ScaledRay({}, 1)};

  bool test(std::int64_t id) {
    const std::int64_t whole = (*ids)[static_cast<std::size_t>(id)];
    best.keep_nearer(cuts.hit(ray, whole).t, whole);
    return any && best.found();
  }
  double limit() const { return best.t; }
};

struct PartTracer::AllCut {
  const CutSet& cuts;
  std::vector<Crossing>& found;
  const std::vector<std::int64_t>* ids = nullptr;
  CutRay ray{ScaledRay({}, 1)};

  bool test(std::int64_t id) const {
    const std::int64_t whole = (*ids)[static_cast<std::size_t>(id)];
    const double t = cuts.hit(ray, whole).t;
    if (t < kFarthestEnd) found.push_back({t, whole});
    return false;
  }
  static double limit() { return kFarthestEnd; }
};

// The answer's ray must enter these balls.
template <class Answer>
void PartTracer::CutBalls::walk_with(Answer& answer) const {
  if (is_brute(tracer->engine())) {
    for (std::int64_t id = 0; id < spheres.size(); ++id)
      if (answer.test(id)) return;
    return;
  }
  NoObserver observer;
  walk(tree, spheres, answer.ray.ray, answer, observer);
}

// False: the ray meets none of them, as the clips alone say.
template <class Answer>
bool PartTracer::prepare(const CutBalls& balls, const Ray& ray, Answer& answer) const {
  if (!is_valid(ray)) return false;
  answer.ids = &balls.ids;
  cuts_->enter(ray, balls.any, answer.ray);
  return CutSet::narrow(balls.common, answer.ray);
}

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
  if (whole.has_images()) {
    if (cuts != nullptr) return Error{"clips cannot cut the copies of a replicated set", "", 0, 0, ""};
    Result<std::shared_ptr<const ImageTracer>> made =
        ImageTracer::build(whole, parameters.engine, parameters.tree, parameters.threads, &ids);
    if (!made) return made.error();
    images_ = std::move(*made);
    return Done{};
  }
  cuts_ = std::move(cuts);
  std::vector<std::int64_t> cut;
  for (const std::int64_t id : ids) {
    const Remainder remainder = cuts_ == nullptr ? Remainder::whole : cuts_->remainder(id);
    if (remainder == Remainder::whole) whole_.ids.push_back(id);
    if (remainder == Remainder::cut) cut.push_back(id);
  }
  try {
    if (Status status = whole_.make(whole, parameters, parameters.finds_all_hits); !status) return status;
    return make_cut(whole, cut, parameters);
  } catch (const std::bad_alloc&) {
    return no_memory_for("the parts of the set");
  }
}

// Spheres that the same clips cut lie together, because what these clips take is known before the walk. The last group
// takes what is beyond the number of groups.
Status PartTracer::make_cut(const SphereSet& whole, const std::vector<std::int64_t>& cut,
                            const Parameters& parameters) {
  std::map<std::uint64_t, std::size_t> group_of;
  for (const std::int64_t id : cut) {
    const std::uint64_t clips = cuts_->cutting(id);
    const std::size_t group = group_of.emplace(clips, std::min(group_of.size(), kMostGroups - 1)).first->second;
    if (group == cut_.size()) cut_.push_back(std::make_unique<CutBalls>());
    cut_[group]->ids.push_back(id);
    cut_[group]->common &= clips;
    cut_[group]->any |= clips;
  }
  Parameters of_cut = parameters;
  of_cut.tree.max_prims = kPrimsOfCut;
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    if (Status status = balls->make(whole, of_cut, !is_brute(parameters.engine)); !status) return status;
  return Done{};
}

// A ray that leaves the ball of a cut sphere may leave an equal ball here, and one that leaves a round cap a ball that
// fills it.
std::int64_t PartTracer::left_here(const Balls& balls, const CutRay& entered) {
  const bool leaves_round = entered.ray.left_radius >= 0;
  return leaves_round ? balls.place_of(entered.ray.left_centre, entered.ray.left_radius) : kNothing;
}

Ray PartTracer::ray_to(const Balls& balls, const Ray& ray) const {
  Ray here = ray;
  const bool is_sphere = ray.leaves >= 0 && ray.leaves < static_cast<std::int64_t>(balls.own_place.size());
  here.leaves = is_sphere ? balls.own_place[static_cast<std::size_t>(ray.leaves)] : kNothing;
  if (cuts_ == nullptr || !cuts_->is_cut(ray.leaves)) return here;
  if (here.leaves == kNothing && !cuts_->has_round_clips()) return here;
  const CutRay entered = cuts_->entering(ray, 0);
  here.leaves = left_here(balls, entered);
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
    const bool is_sphere = leaves >= 0 && leaves < static_cast<std::int64_t>(balls.own_place.size());
    const std::int64_t own = is_sphere ? balls.own_place[static_cast<std::size_t>(leaves)] : kNothing;
    if (cuts_ != nullptr && cuts_->is_cut(leaves) && (own != kNothing || cuts_->has_round_clips())) {
      const Ray ray = ray_to(balls, rays.at(static_cast<std::int64_t>(i)));
      arrays.leaves[i] = ray.leaves;
      arrays.inside[i] = ray.inside ? 1 : 0;
      continue;
    }
    arrays.leaves[i] = own;
    if (cuts_ != nullptr) arrays.inside[i] = rays.inside != nullptr ? rays.inside[i] : 0;
  }
  return here;
}

Hit PartTracer::closest_hit(const Ray& ray) const {
  if (images_) return images_->closest_hit(ray);
  Hit hit = whole_.tracer->closest_hit(ray_to(whole_, ray));
  if (hit.found()) hit.sphere_id = whole_.whole_id(hit.sphere_id);
  if (cut_.empty()) return hit;
  NearestCut nearest{*cuts_, false, hit};
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    if (prepare(*balls, ray, nearest)) balls->walk_with(nearest);
  return nearest.best;
}

bool PartTracer::occluded(const Ray& ray) const {
  if (images_) return images_->occluded(ray);
  if (whole_.tracer->occluded(ray_to(whole_, ray))) return true;
  if (cut_.empty()) return false;
  NearestCut nearest{*cuts_, true, {}};
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    if (!nearest.best.found() && prepare(*balls, ray, nearest)) balls->walk_with(nearest);
  return nearest.best.found();
}

// Of each ray whether it needs a look, and how the quick question for all of them sees it. Rays that leave a cut sphere
// are looked at here: most leave a cap, and go where these clips leave nothing.
RaySpan PartTracer::rays_to_look_at(const CutBalls& balls, const RaySpan& rays, const std::uint8_t* hidden,
                                    RayArrays& arrays) const {
  const auto count = static_cast<std::size_t>(rays.count);
  for (auto* bytes : {&arrays.near_cut, &arrays.inside}) bytes->resize(count);
  arrays.leaves.resize(count);
  arrays.ends.resize(count);
  CutRay entered{ScaledRay({}, 1)};
  for (std::size_t i = 0; i < count; ++i) {
    const double start = rays.t_min != nullptr ? rays.t_min[i] : 0;
    const bool no_segment = rays.t_max != nullptr && rays.t_max[i] < start;
    bool looks = !no_segment && (hidden == nullptr || hidden[i] == 0);
    const std::int64_t leaves = rays.leaves != nullptr ? rays.leaves[i] : kNothing;
    arrays.inside[i] = rays.inside != nullptr ? rays.inside[i] : 0;
    arrays.leaves[i] = kNothing;
    if (looks && cuts_->is_cut(leaves)) {
      cuts_->enter(rays.at(static_cast<std::int64_t>(i)), balls.common & balls.any, entered);
      looks = CutSet::narrow(balls.common & balls.any, entered);
      arrays.leaves[i] = left_here(balls, entered);
      arrays.inside[i] = entered.ray.inside ? 1 : 0;
    } else if (leaves >= 0 && leaves < static_cast<std::int64_t>(balls.own_place.size())) {
      arrays.leaves[i] = balls.own_place[static_cast<std::size_t>(leaves)];
    }
    arrays.near_cut[i] = looks ? 1 : 0;
    arrays.ends[i] = looks ? kFarthestEnd : -kFarthestEnd;
  }
  RaySpan here = rays;
  here.leaves = arrays.leaves.data();
  here.inside = arrays.inside.data();
  here.t_max = arrays.ends.data();
  return here;
}

// A ray meets a cut sphere only if the line behind its start meets the ball, which many rays ask quickly. The end of
// the segment does not matter here: the whole segment may lie in the ball, and a cap in the segment.
template <class Use>
void PartTracer::for_each_near(const CutBalls& balls, const RaySpan& rays, RayOrder order, const std::uint8_t* hidden,
                               const Use& use) const {
  static thread_local RayArrays arrays;
  const RaySpan here = rays_to_look_at(balls, rays, hidden, arrays);
  if (balls.tracer->engine() == Engine::wide) balls.tracer->occluded(here, order, arrays.near_cut.data());
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (arrays.near_cut[static_cast<std::size_t>(i)] != 0) use(i);
}

void PartTracer::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  if (images_) return images_->closest_hits(rays, order, hits);
  static thread_local RayArrays arrays;
  whole_.tracer->closest_hits(rays_to(whole_, rays, arrays), order, hits);
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (hits.sphere_id[i] >= 0) hits.sphere_id[i] = whole_.whole_id(hits.sphere_id[i]);
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    for_each_near(*balls, rays, order, nullptr, [&](std::int64_t i) {
      NearestCut nearest{*cuts_, false, {hits.t[i], hits.sphere_id[i]}};
      if (!prepare(*balls, rays.at(i), nearest)) return;
      balls->walk_with(nearest);
      hits.t[i] = nearest.best.t;
      hits.sphere_id[i] = nearest.best.sphere_id;
    });
}

void PartTracer::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* hidden) const {
  if (images_) return images_->occluded(rays, order, hidden);
  static thread_local RayArrays arrays;
  whole_.tracer->occluded(rays_to(whole_, rays, arrays), order, hidden);
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    for_each_near(*balls, rays, order, hidden, [&](std::int64_t i) {
      NearestCut nearest{*cuts_, true, {}};
      if (!prepare(*balls, rays.at(i), nearest)) return;
      balls->walk_with(nearest);
      if (nearest.best.found()) hidden[i] = 1;
    });
}

void PartTracer::all_hits(const Ray& ray, std::vector<Crossing>& found) const {
  if (images_) return images_->all_hits(ray, found);
  found.clear();
  if (!is_valid(ray)) return;
  AllWholeHits all{whole_.ids, found};
  NoObserver observer;
  walk(whole_.tree, whole_.spheres, ScaledRay(ray_to(whole_, ray), whole_.spheres), all, observer);
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    if (AllCut all_cut{*cuts_, found}; prepare(*balls, ray, all_cut)) balls->walk_with(all_cut);
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
    arrays.ends[static_cast<std::size_t>(i)] = arrays.near_cut[static_cast<std::size_t>(i)] != 0 ? end : -kFarthestEnd;
  }
  here.t_max = arrays.ends.data();
  bihive::all_hits(*whole_.tracer->wide_tree(), here, found);
  for (RayHit& hit : found) hit.sphere_id = whole_.whole_id(hit.sphere_id);
}

void PartTracer::all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  if (images_) return images_->all_hits(rays, order, found);
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
  for (const std::unique_ptr<CutBalls>& balls : cut_)
    for_each_near(*balls, rays, order, nullptr, [&](std::int64_t i) {
      of_ray.clear();
      if (AllCut all_cut{*cuts_, of_ray}; prepare(*balls, rays.at(i), all_cut)) balls->walk_with(all_cut);
      for (const Crossing& crossing : of_ray) found.push_back({i, crossing.t, crossing.id});
    });
  if (found.size() == of_whole) return;
  std::sort(found.begin(), found.end(), [](const RayHit& a, const RayHit& b) {
    return a.ray != b.ray ? a.ray < b.ray : before({a.t, a.sphere_id}, {b.t, b.sphere_id});
  });
}

}  // namespace bihive
