// Spheres that clips cut open (geometry/cut_sphere.h), beside those that are whole.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/render/query/build_engine.h"
#include "bihive/render/query/subset_engine.h"

namespace bihive {

/// A decorator: adds the cut spheres of a set to an engine of its whole ones. A tree of the cut spheres' balls says
/// which of them a ray may meet, and CutSet where.
class CutEngine final : public RayEngine {
 public:
  /// `cut`: ids of spheres in `all`, ascending, that `cuts` cuts. std::bad_alloc: there is not enough memory.
  static Result<std::shared_ptr<const RayEngine>> build(const SphereSet& all, const std::vector<std::int64_t>& cut,
                                                        std::shared_ptr<const CutSet> cuts,
                                                        std::shared_ptr<const RayEngine> of_whole,
                                                        const EngineParameters& parameters);

  Hit closest_hit(const Ray& ray) const override;
  bool occluded(const Ray& ray) const override;
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override;
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override;
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override;
  void optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                      const DepthSums& sums) const override;

 private:
  // Cut spheres with trees of their balls.
  struct Balls {
    Subset subset;
    std::uint64_t common;  // the clips that cut all of them
    std::uint64_t any;     // the clips that cut some of them
    bool has_tree = false;
    Tree tree{};
    std::shared_ptr<const RayEngine> quick{};  // says for many rays whether they meet a ball; null: there is
                                               // none
  };
  struct Nearest;
  struct All;

  // Whether each ray needs a look at these balls, and how the quick question for all of them sees it.
  struct Looks {
    std::vector<std::int64_t> leaves;
    std::vector<std::uint8_t> inside, is_near;
    std::vector<double> ends;
  };
  RaySpan find_looks(const Balls& balls, const RaySpan& rays, const std::uint8_t* is_occluded, Looks& looks) const;
  // Calls use(i) for each ray i that may meet one of the balls. `is_occluded`: 1 for rays that need no look, or null.
  template <class Use>
  void for_each_near(const Balls& balls, const RaySpan& rays, RayOrder order, const std::uint8_t* is_occluded,
                     const Use& use) const;
  // Takes the ray to all balls that it may meet.
  template <class Answer>
  void look_at(const Balls& balls, const Ray& ray, Answer& answer) const;

  std::shared_ptr<const CutSet> cuts_;
  std::shared_ptr<const RayEngine> of_whole_;
  std::vector<std::unique_ptr<Balls>> groups_;  // by the clips that cut them; engines refer to their spheres
};

}  // namespace bihive
