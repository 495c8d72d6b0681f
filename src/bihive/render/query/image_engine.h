// Queries on a set with images (SphereSet::replicate): one tree of the stored spheres, met by each ray where each image
// lies (docs/decisions/0023-images-in-the-traversal.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/query/build_engine.h"
#include "bihive/render/query/image_ranges.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

/// The answers are those of an engine of a set that holds the copies, bit for bit.
class ImageEngine final : public RayEngine {
 public:
  /// Of all spheres of `whole`, which must outlive it; with `ids` (ascending) of these stored spheres and their images.
  /// Ids of rays and hits are those of the whole set. Errors: as Tracer::build().
  static Result<std::shared_ptr<const RayEngine>> build(const SphereSet& whole, const std::vector<std::int64_t>* ids,
                                                        const EngineParameters& parameters);

  Hit closest_hit(const Ray& ray) const override;
  bool occluded(const Ray& ray) const override;
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override;
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override;
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override;
  /// `depths` are those of the stored spheres.
  void optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                      const DepthSums& sums) const override;

  /// Of the stored spheres.
  const Tree* tree() const override { return engine_ == Engine::reference ? tree_.get() : nullptr; }
  const WideTree* wide_tree() const override { return wide_.get(); }

 private:
  using Range = ImageRange;
  using Box = ImageBox;
  struct RayBox;
  struct Batch;
  template <bool kAnyHit>
  struct NearestOfImages;
  struct AllOfImages;
  template <class Answer>
  struct AnswerOfImage;

  Range all_images() const { return {{0, 0, 0}, spheres().images().counts}; }
  Box box_of(const Range& range) const {
    return bihive::box_of(range, stored_box_, spheres().images(), spheres().scale());
  }
  Vec3d stored_shift(const Range& image) const;
  const SphereSet& spheres() const { return ids_.empty() ? *whole_ : part_; }
  std::int64_t whole_id(std::int64_t id, std::int64_t image) const {
    return (ids_.empty() ? id : ids_[static_cast<std::size_t>(id)]) + image * whole_->size();
  }
  // The sphere that a ray leaves as the tree of an image knows it.
  std::int64_t left_in(std::int64_t image, std::int64_t leaves) const;
  // By their places in place of ids. It takes longer.
  bool by_place(std::int64_t leaves) const;

  template <class Answer>
  void walk_range(const Range& range, const ScaledRay& ray, Answer& answer) const;
  template <class Visit>
  void visit_images(const Ray& ray, Visit& visit) const;

  static Batch& batch_of_this_thread();
  template <class Alone>
  void prepare(const RaySpan& rays, Batch& batch, const Alone& alone) const;
  template <class Leaf, class Limit>
  void visit_range(const Range& range, std::size_t begin, Batch& batch, const Leaf& leaf, const Limit& limit) const;
  RaySpan rays_of(std::int64_t image, std::size_t begin, const double* best_t, Batch& batch) const;

  const SphereSet* whole_ = nullptr;
  SphereSet part_;
  std::vector<std::int64_t> ids_;      // of the part in the whole; empty: all
  std::vector<std::int64_t> part_of_;  // of each stored sphere of the whole: the part's, or kNothing
  Engine engine_ = Engine::wide;
  std::shared_ptr<const WideTree> wide_;
  std::shared_ptr<const Tree> tree_;
  Box stored_box_;
  bool may_coincide_ = false;
};

}  // namespace bihive
