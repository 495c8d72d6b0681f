#include "bihive/render/query/cut_engine.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"

namespace bihive {
namespace {

// Groups of cut spheres, and spheres of a leaf of their trees: a test of a cut sphere costs more than that of a box.
constexpr std::size_t kMostGroups = 8;
constexpr std::int64_t kPrimsOfCut = 2;

constexpr double kFarthestEnd = std::numeric_limits<double>::infinity();

}  // namespace

// The hits of a ray on cut spheres: the closest one or any, or all of them.
struct CutEngine::Nearest {
  const CutSet& cuts;
  bool any;
  Hit best;
  const Subset* subset = nullptr;
  CutRay ray{ScaledRay({}, 1)};

  bool test(std::int64_t id) {
    const std::int64_t whole = subset->whole_id(id);
    best.keep_nearer(cuts.hit(ray, whole).t, whole);
    return any && best.found();
  }
  double limit() const { return best.t; }
};

struct CutEngine::All {
  const CutSet& cuts;
  AllHits all;
  const Subset* subset = nullptr;
  CutRay ray{ScaledRay({}, 1)};

  bool test(std::int64_t id) const {
    const std::int64_t whole = subset->whole_id(id);
    return all.take(cuts.hit(ray, whole).t, whole);
  }
  static double limit() { return AllHits::limit(); }
};

// Spheres that the same clips cut lie together, because what these clips take is known before the traversal. The last
// group takes what is beyond the number of groups.
Result<std::shared_ptr<const RayEngine>> CutEngine::build(const SphereSet& all, const std::vector<std::int64_t>& cut,
                                                          std::shared_ptr<const CutSet> cuts,
                                                          std::shared_ptr<const RayEngine> of_whole,
                                                          const EngineParameters& parameters) {
  struct Group {
    std::vector<std::int64_t> ids{};
    std::uint64_t common = ~std::uint64_t{0}, any = 0;
  };
  std::vector<Group> groups;
  std::map<std::uint64_t, std::size_t> group_of;
  for (const std::int64_t id : cut) {
    const std::uint64_t clips = cuts->cutting(id);
    const std::size_t number = group_of.emplace(clips, std::min(group_of.size(), kMostGroups - 1)).first->second;
    if (number == groups.size()) groups.emplace_back();
    groups[number].ids.push_back(id);
    groups[number].common &= clips;
    groups[number].any |= clips;
  }

  auto made = std::make_shared<CutEngine>();
  EngineParameters of_cut = parameters;
  of_cut.tree.max_prims = kPrimsOfCut;
  for (Group& group : groups) {
    made->groups_.push_back(std::make_unique<Balls>(Balls{Subset(all, std::move(group.ids)), group.common, group.any}));
    Balls& balls = *made->groups_.back();
    balls.has_tree = !is_brute(parameters.engine);
    if (balls.has_tree) balls.tree = build_reference_tree(balls.subset.spheres(), of_cut.tree.for_reference());
    if (parameters.engine != Engine::wide) continue;
    Result<std::shared_ptr<const RayEngine>> quick = build_engine(balls.subset.spheres(), of_cut);
    if (!quick) return quick.error();
    balls.quick = std::move(*quick);
  }
  made->cuts_ = std::move(cuts);
  made->of_whole_ = std::move(of_whole);
  return std::shared_ptr<const RayEngine>(std::move(made));
}

template <class Answer>
void CutEngine::look_at(const Balls& balls, const Ray& ray, Answer& answer) const {
  if (!is_valid(ray)) return;
  answer.subset = &balls.subset;
  cuts_->enter(ray, balls.any, answer.ray);
  if (!CutSet::narrow(balls.common, answer.ray)) return;  // the ray meets none of them, as the clips alone say
  if (balls.has_tree) {
    NoObserver observer;
    return walk(balls.tree, balls.subset.spheres(), answer.ray.ray, answer, observer);
  }
  for (std::int64_t id = 0; id < balls.subset.spheres().size(); ++id)
    if (answer.test(id)) return;
}

Hit CutEngine::closest_hit(const Ray& ray) const {
  Nearest nearest{*cuts_, false, of_whole_->closest_hit(ray)};
  for (const std::unique_ptr<Balls>& balls : groups_) look_at(*balls, ray, nearest);
  return nearest.best;
}

bool CutEngine::occluded(const Ray& ray) const {
  if (of_whole_->occluded(ray)) return true;
  Nearest nearest{*cuts_, true, {}};
  for (const std::unique_ptr<Balls>& balls : groups_)
    if (!nearest.best.found()) look_at(*balls, ray, nearest);
  return nearest.best.found();
}

// Rays that exit a cut sphere are looked at here: most exit a cap, and go where these clips leave nothing.
RaySpan CutEngine::find_looks(const Balls& balls, const RaySpan& rays, const std::uint8_t* is_occluded,
                              Looks& looks) const {
  const auto count = static_cast<std::size_t>(rays.count);
  for (auto* bytes : {&looks.is_near, &looks.inside}) bytes->resize(count);
  looks.leaves.resize(count);
  looks.ends.resize(count);
  CutRay entered{ScaledRay({}, 1)};
  for (std::size_t i = 0; i < count; ++i) {
    const double start = rays.t_min != nullptr ? rays.t_min[i] : 0;
    const bool no_segment = rays.t_max != nullptr && rays.t_max[i] < start;
    bool is_near = !no_segment && (is_occluded == nullptr || is_occluded[i] == 0);
    const std::int64_t leaves = rays.leaves != nullptr ? rays.leaves[i] : kNothing;
    looks.inside[i] = rays.inside != nullptr ? rays.inside[i] : 0;
    if (is_near && cuts_->is_cut(leaves)) {
      cuts_->enter(rays.at(static_cast<std::int64_t>(i)), balls.common & balls.any, entered);
      is_near = CutSet::narrow(balls.common & balls.any, entered);
      looks.leaves[i] = balls.subset.equal_of(entered);
      looks.inside[i] = entered.ray.inside ? 1 : 0;
    } else {
      looks.leaves[i] = balls.subset.equal_of(leaves);
    }
    looks.is_near[i] = is_near ? 1 : 0;
    looks.ends[i] = is_near ? kFarthestEnd : -kFarthestEnd;
  }
  RaySpan here = rays;
  here.leaves = looks.leaves.data();
  here.inside = looks.inside.data();
  here.t_max = looks.ends.data();
  return here;
}

// A ray meets a cut sphere only if the line behind its start meets the ball, which many rays ask quickly. The end of
// the segment does not matter here: the whole segment may lie in the ball, and a cap in the segment.
template <class Use>
void CutEngine::for_each_near(const Balls& balls, const RaySpan& rays, RayOrder order, const std::uint8_t* is_occluded,
                              const Use& use) const {
  if (balls.quick == nullptr) {
    for (std::int64_t i = 0; i < rays.count; ++i)
      if (is_occluded == nullptr || is_occluded[i] == 0) use(i);
    return;
  }
  static thread_local Looks looks;
  const RaySpan here = find_looks(balls, rays, is_occluded, looks);
  balls.quick->occluded(here, order, looks.is_near.data());
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (looks.is_near[static_cast<std::size_t>(i)] != 0) use(i);
}

void CutEngine::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  of_whole_->closest_hits(rays, order, hits);
  for (const std::unique_ptr<Balls>& balls : groups_)
    for_each_near(*balls, rays, order, nullptr, [&](std::int64_t i) {
      Nearest nearest{*cuts_, false, {hits.t[i], hits.sphere_id[i]}};
      look_at(*balls, rays.at(i), nearest);
      hits.t[i] = nearest.best.t;
      hits.sphere_id[i] = nearest.best.sphere_id;
    });
}

void CutEngine::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  of_whole_->occluded(rays, order, is_occluded);
  for (const std::unique_ptr<Balls>& balls : groups_)
    for_each_near(*balls, rays, order, is_occluded, [&](std::int64_t i) {
      Nearest nearest{*cuts_, true, {}};
      look_at(*balls, rays.at(i), nearest);
      if (nearest.best.found()) is_occluded[i] = 1;
    });
}

void CutEngine::all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  of_whole_->all_hits(rays, order, found);
  const std::size_t of_whole = found.size();
  for (const std::unique_ptr<Balls>& balls : groups_)
    for_each_near(*balls, rays, order, nullptr, [&](std::int64_t i) {
      All all{*cuts_, {i, found}};
      look_at(*balls, rays.at(i), all);
    });
  if (found.size() > of_whole) sort_hits(found);
}

void CutEngine::optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                               const DepthSums& sums) const {
  of_whole_->optical_depths(rays, order, depths, sums);
  static thread_local std::vector<RayHit> found;
  for (const std::unique_ptr<Balls>& balls : groups_)
    for_each_near(*balls, rays, order, nullptr, [&](std::int64_t i) {
      found.clear();
      All all{*cuts_, {i, found}};
      look_at(*balls, rays.at(i), all);
      for (const RayHit& hit : found) sums.add(i, depths.row(hit.sphere_id), depths.columns);
    });
}

}  // namespace bihive
