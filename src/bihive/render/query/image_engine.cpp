#include "bihive/render/query/image_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/render/query/coinciding_images.h"
#include "bihive/wide/queries.h"

namespace bihive {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Rounding moves the centre of an image by up to 2^-25, and the sums here have errors of some 2^-53.
constexpr double kImagePad = 0x1p-24;

// Rays that start farther away are not for the boxes in binary32.
constexpr double kFarthestForBoxes = 1e18;

}  // namespace

Result<std::shared_ptr<const RayEngine>> ImageEngine::build(const SphereSet& whole,
                                                            const std::vector<std::int64_t>* ids,
                                                            const EngineParameters& parameters) {
  try {
    auto made = std::make_shared<ImageEngine>();
    made->whole_ = &whole;
    made->engine_ = parameters.engine;
    if (ids != nullptr && static_cast<std::int64_t>(ids->size()) < whole.size()) {
      made->part_ = whole.part(*ids);
      made->ids_ = *ids;
      made->part_of_.resize(static_cast<std::size_t>(whole.size()), kNothing);
      for (std::size_t i = 0; i < ids->size(); ++i)
        made->part_of_[static_cast<std::size_t>((*ids)[i])] = static_cast<std::int64_t>(i);
      if (ids->empty()) made->ids_.push_back(kNothing);  // so that the part is in use
    }
    const SphereSet& spheres = made->spheres();
    Box& box = made->stored_box_;
    box = {{kNoLimit, kNoLimit, kNoLimit}, {-kNoLimit, -kNoLimit, -kNoLimit}};
    for (std::int64_t id = 0; id < spheres.size(); ++id)
      for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], spheres.stored_centre(id)[axis] - spheres.stored_radius(id));
        box.hi[axis] = std::max(box.hi[axis], spheres.stored_centre(id)[axis] + spheres.stored_radius(id));
      }
    made->may_coincide_ = !whole.empty() && images_may_coincide(whole);

    if (made->engine_ == Engine::wide) {
      Result<std::shared_ptr<const WideTree>> tree =
          WideBuilder().build(spheres, parameters.tree.for_wide(spheres.size()), parameters.threads);
      if (!tree) return tree.error();
      made->wide_ = std::move(*tree);
    }
    if (made->engine_ == Engine::reference || (made->engine_ == Engine::wide && made->may_coincide_))
      made->tree_ = std::make_shared<const Tree>(build_reference_tree(spheres, parameters.tree.for_reference()));
    return std::shared_ptr<const RayEngine>(std::move(made));
  } catch (const std::bad_alloc&) {
    return no_memory_for("the tree of " + std::to_string(whole.size()) + " spheres");
  }
}

Vec3d ImageEngine::stored_shift(const Range& image) const {
  return spheres().scale() * spheres().images().shift(image.first);
}

std::int64_t ImageEngine::left_in(std::int64_t image, std::int64_t leaves) const {
  if (leaves < 0) return kNothing;  // kNothing is too small to subtract from
  const std::int64_t id = leaves - image * whole_->size();
  if (id < 0 || id >= whole_->size()) return kNothing;
  return ids_.empty() ? id : part_of_[static_cast<std::size_t>(id)];
}

bool ImageEngine::by_place(std::int64_t leaves) const {
  return wide_ == nullptr || (may_coincide_ && leaves >= 0);
}

// ---- One ray ----

// A step of the walk through the tree of one image: the scalar truth on the image's spheres.
template <class Answer>
struct ImageEngine::AnswerOfImage {
  const ImageEngine& tracer;
  const ScaledRay& ray;
  Vec3d shift;
  std::int64_t image;
  Answer& answer;
  bool ended = false;

  bool test(std::int64_t id) {
    const SphereSet& spheres = tracer.spheres();
    const Vec3d own = spheres.stored_centre(id);
    const Vec3d centre = image == 0 ? own : to_double(to_float(own + shift));
    ended = answer.take(sphere_hit(ray, centre, spheres.stored_radius(id)), tracer.whole_id(id, image));
    return ended;
  }
  double limit() const { return answer.limit(); }
};

template <class Visit>
void ImageEngine::visit_images(const Ray& ray, Visit& visit) const {
  if (spheres().empty()) return;
  const double scale = spheres().scale();
  visit_image_boxes(spheres().images(), scale, stored_box_, ScaledRay(ray, scale), visit);
}

// Flattened, as ReferenceEngine is.
template <class Answer>
[[gnu::flatten]] void ImageEngine::walk_range(const Range& range, const ScaledRay& ray, Answer& answer) const {
  AnswerOfImage<Answer> of_image{*this, ray, stored_shift(range), spheres().images().number(range.first), answer};
  if (is_brute(engine_)) {
    for (std::int64_t id = 0; id < spheres().size(); ++id)
      if (of_image.test(id)) return;
    return;
  }
  ScaledRay in_tree = ray;
  in_tree.origin = ray.origin - of_image.shift;
  NoObserver observer;
  walk(*tree_, spheres(), in_tree, of_image, observer, kImagePad);
}

// The closest hit of a ray on the images that it visits, or any.
template <bool kAnyHit>
struct ImageEngine::NearestOfImages {
  const ImageEngine& tracer;
  const Ray& ray;
  ScaledRay scaled;
  NearestAnswer<kAnyHit> nearest;

  double limit() const { return nearest.best.t; }
  bool visit(const Range& range) {
    if (tracer.by_place(ray.leaves)) {
      tracer.walk_range(range, scaled, nearest);
      return kAnyHit && nearest.best.found();
    }
    const std::int64_t image = tracer.spheres().images().number(range.first);
    const WideTree tree = tracer.wide_->image(tracer.stored_shift(range));
    Ray here = ray;
    here.t_max = std::min(ray.t_max, nearest.best.t);
    here.leaves = tracer.left_in(image, ray.leaves);
    if constexpr (kAnyHit) {
      if (bihive::occluded(tree, here)) nearest.best = {0, 0};
      return nearest.best.found();
    } else {
      const Hit hit = bihive::closest_hit(tree, here);
      if (hit.found()) nearest.best.keep_nearer(hit.t, tracer.whole_id(hit.sphere_id, image));
      return false;
    }
  }
};

Hit ImageEngine::closest_hit(const Ray& ray) const {
  if (!is_valid(ray)) return {};
  NearestOfImages<false> nearest{*this, ray, ScaledRay(ray, *whole_), {}};
  visit_images(ray, nearest);
  return nearest.nearest.best;
}

bool ImageEngine::occluded(const Ray& ray) const {
  if (!is_valid(ray)) return false;
  NearestOfImages<true> nearest{*this, ray, ScaledRay(ray, *whole_), {}};
  visit_images(ray, nearest);
  return nearest.nearest.best.found();
}

struct ImageEngine::AllOfImages {
  const ImageEngine& tracer;
  ScaledRay scaled;
  AllHits all;

  static double limit() { return kNoLimit; }
  bool visit(const Range& range) {
    tracer.walk_range(range, scaled, all);
    return false;
  }
};

// ---- Many rays: each image gets those that may meet it ----

// A ray against boxes, in binary32. Directions are scaled, so that the largest component is 1; s = t * factor. Planes
// are moved outward by `pad`, which is more than all roundings: 2^-18 of the largest number that is met.
struct ImageEngine::RayBox {
  float origin[3], inverse[3];
  float pad, s_min;
  double factor;

  RayBox(const Ray& ray, double scale) {
    double largest = 0;
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      largest = std::max(largest, std::abs(double(ray.direction[axis])));
      farthest = std::max(farthest, std::abs(double(ray.origin[axis]) * scale));
    }
    factor = largest * scale;
    const bool always = !(farthest < kFarthestForBoxes);
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] = always ? 0 : static_cast<float>(double(ray.origin[axis]) * scale);
      const double along = double(ray.direction[axis]) / largest;
      inverse[axis] = static_cast<float>(1 / std::copysign(std::max(std::abs(along), 1e-18), along));
    }
    pad = always ? std::numeric_limits<float>::infinity() : static_cast<float>(0x1p-18 * (farthest + 2));
    const double s = ray.t_min * factor;
    s_min = static_cast<float>(std::clamp(s - 0x1p-20 * std::abs(s), -1e30, 1e30));
  }
  float upper(double t) const {
    const double s = t * factor;
    return s < 1e30 ? static_cast<float>(s + 0x1p-20 * std::abs(s)) : std::numeric_limits<float>::infinity();
  }
  bool meets(const float lo[3], const float hi[3], float s_max) const {
    float in = s_min;
    float out = s_max;
    for (int axis = 0; axis < 3; ++axis) {
      const float one = (lo[axis] - pad - origin[axis]) * inverse[axis];
      const float other = (hi[axis] + pad - origin[axis]) * inverse[axis];
      in = std::max(in, std::min(one, other));
      out = std::min(out, std::max(one, other));
    }
    return !(in > out);
  }
};

// Rays on their way through the ranges of images. Each thread keeps one.
struct ImageEngine::Batch {
  const RaySpan* rays = nullptr;
  std::vector<RayBox> boxes;
  std::vector<std::uint32_t> list;  // of all ranges that are open; a range's is at the end
  RayBatch here;                    // of one image
  HitBatch hits;
  std::vector<std::uint8_t> hidden;
  std::vector<RayHit> found;
};

// Fills the list with the rays that may meet something, and calls alone(i) for those that go one at a time.
template <class Alone>
void ImageEngine::prepare(const RaySpan& rays, Batch& batch, const Alone& alone) const {
  batch.rays = &rays;
  batch.boxes.clear();
  batch.list.clear();
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const Ray ray = rays.at(i);
    batch.boxes.emplace_back(ray, spheres().scale());
    if (!is_valid(ray)) continue;
    if (by_place(ray.leaves))
      alone(i, ray);
    else
      batch.list.push_back(static_cast<std::uint32_t>(i));
  }
}

// Calls leaf(image, range, begin) for images with the rays of batch.list from `begin` on that may meet their boxes
// before limit(ray), which is below 0 for rays that need no more.
template <class Leaf, class Limit>
void ImageEngine::visit_range(const Range& range, std::size_t begin, Batch& batch, const Leaf& leaf,
                              const Limit& limit) const {
  // The rays that meet the box.
  const Box box = box_of(range);
  float lo[3], hi[3];
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = static_cast<float>(box.lo[axis]);
    hi[axis] = static_cast<float>(box.hi[axis]);
  }
  const std::size_t end = batch.list.size();
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t i = batch.list[k];
    const double t = limit(i);
    if (batch.boxes[i].meets(lo, hi, batch.boxes[i].upper(t)) && t > -kNoLimit) batch.list.push_back(i);
  }
  if (batch.list.size() > end) {
    if (range.is_single()) {
      leaf(range, end);
    } else {
      // The half that is nearer to the first ray first.
      std::size_t side = 0;
      const std::array<Range, 2> two = range.halves(side);
      const Ray first = batch.rays->at(batch.list[end]);
      const bool in_order = dot(spheres().images().vectors[side], to_double(first.direction)) >= 0;
      visit_range(two[in_order ? 0 : 1], end, batch, leaf, limit);
      visit_range(two[in_order ? 1 : 0], end, batch, leaf, limit);
    }
  }
  batch.list.resize(end);
}

// The rays of the list from `begin` on, as the tree of an image is to see them: up to best_t, if that is given.
RaySpan ImageEngine::rays_of(std::int64_t image, std::size_t begin, const double* best_t, Batch& batch) const {
  const RaySpan& rays = *batch.rays;
  const std::uint32_t* const list = batch.list.data() + begin;
  const std::size_t count = batch.list.size() - begin;
  RayBatch& here = batch.here;
  here.resize(static_cast<std::int64_t>(count));
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < count; ++k) {
      here.origin[axis][k] = rays.origin[axis][list[k]];
      here.direction[axis][k] = rays.direction[axis][list[k]];
    }
  here.t_min.clear();
  here.t_max.clear();
  here.leaves.clear();
  here.inside.clear();
  if (rays.t_min != nullptr)
    for (std::size_t k = 0; k < count; ++k) here.t_min.push_back(rays.t_min[list[k]]);
  bool has_end = rays.t_max != nullptr;
  for (std::size_t k = 0; best_t != nullptr && !has_end && k < count; ++k) has_end = best_t[list[k]] < kNoLimit;
  if (has_end)
    for (std::size_t k = 0; k < count; ++k) {
      const double given = rays.t_max != nullptr ? rays.t_max[list[k]] : kNoLimit;
      here.t_max.push_back(best_t != nullptr ? std::min(given, best_t[list[k]]) : given);
    }
  if (rays.leaves != nullptr)
    for (std::size_t k = 0; k < count; ++k) here.leaves.push_back(left_in(image, rays.leaves[list[k]]));
  if (rays.inside != nullptr)
    for (std::size_t k = 0; k < count; ++k) here.inside.push_back(rays.inside[list[k]]);
  return here.span();
}

ImageEngine::Batch& ImageEngine::batch_of_this_thread() {
  static thread_local Batch batch;
  return batch;
}

void ImageEngine::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  std::fill_n(hits.t, rays.count, kNoLimit);
  std::fill_n(hits.sphere_id, rays.count, kNothing);
  if (spheres().empty()) return;
  Batch& batch = batch_of_this_thread();
  prepare(rays, batch, [&](std::int64_t i, const Ray& ray) {
    const Hit hit = closest_hit(ray);
    hits.t[i] = hit.t;
    hits.sphere_id[i] = hit.sphere_id;
  });
  const auto leaf = [&](const Range& range, std::size_t begin) {
    const std::int64_t image = spheres().images().number(range.first);
    const RaySpan here = rays_of(image, begin, hits.t, batch);
    batch.hits.resize(here.count);
    bihive::closest_hits(wide_->image(stored_shift(range)), here, order, batch.hits.span());
    for (std::int64_t k = 0; k < here.count; ++k) {
      const Hit found = batch.hits.at(k);
      if (!found.found()) continue;
      const std::uint32_t i = batch.list[begin + static_cast<std::size_t>(k)];
      Hit best{hits.t[i], hits.sphere_id[i]};
      best.keep_nearer(found.t, whole_id(found.sphere_id, image));
      hits.t[i] = best.t;
      hits.sphere_id[i] = best.sphere_id;
    }
  };
  visit_range(all_images(), 0, batch, leaf,
              [&](std::uint32_t i) { return rays.t_max != nullptr ? std::min(rays.t_max[i], hits.t[i]) : hits.t[i]; });
}

void ImageEngine::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  std::fill_n(is_occluded, rays.count, std::uint8_t{0});
  if (spheres().empty()) return;
  Batch& batch = batch_of_this_thread();
  prepare(rays, batch, [&](std::int64_t i, const Ray& ray) { is_occluded[i] = occluded(ray) ? 1 : 0; });
  const auto leaf = [&](const Range& range, std::size_t begin) {
    const RaySpan here = rays_of(spheres().images().number(range.first), begin, nullptr, batch);
    batch.hidden.resize(static_cast<std::size_t>(here.count));
    bihive::occluded(wide_->image(stored_shift(range)), here, order, batch.hidden.data());
    for (std::size_t k = 0; k < batch.hidden.size(); ++k)
      if (batch.hidden[k] != 0) is_occluded[batch.list[begin + k]] = 1;
  };
  visit_range(all_images(), 0, batch, leaf, [&](std::uint32_t i) {
    if (is_occluded[i] != 0) return -kNoLimit;
    return rays.t_max != nullptr ? rays.t_max[i] : kNoLimit;
  });
}

void ImageEngine::all_hits(const RaySpan& rays, RayOrder, std::vector<RayHit>& found) const {
  found.clear();
  if (spheres().empty()) return;
  Batch& batch = batch_of_this_thread();
  prepare(rays, batch, [&](std::int64_t i, const Ray& ray) {
    AllOfImages all{*this, ScaledRay(ray, *whole_), {i, found}};
    visit_images(ray, all);
  });
  const auto leaf = [&](const Range& range, std::size_t begin) {
    const std::int64_t image = spheres().images().number(range.first);
    const RaySpan here = rays_of(image, begin, nullptr, batch);
    bihive::all_hits(wide_->image(stored_shift(range)), here, batch.found);
    for (const RayHit& hit : batch.found)
      found.push_back(
          {std::int64_t{batch.list[begin + static_cast<std::size_t>(hit.ray)]}, hit.t, whole_id(hit.sphere_id, image)});
  };
  visit_range(all_images(), 0, batch, leaf,
              [&](std::uint32_t i) { return rays.t_max != nullptr ? rays.t_max[i] : kNoLimit; });
  sort_hits(found);
}

void ImageEngine::optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                                 const DepthSums& sums) const {
  static thread_local std::vector<RayHit> found;
  all_hits(rays, order, found);
  sums.clear(rays.count, depths.columns);
  for (const RayHit& hit : found) sums.add(hit.ray, depths.row(whole_->stored_id(hit.sphere_id)), depths.columns);
}

}  // namespace bihive
