// Queries on some of the spheres of a set, with the ids of the whole set. Clips may cut these spheres open.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"

namespace bihive {

class ImageTracer;

/// Whole spheres have a tracer like any set. Cut ones are apart: a tree of their balls says which of them a ray may
/// meet, and geometry/cut_sphere.h where. Queries are const; any number of threads may call them at a time.
class PartTracer {
 public:
  PartTracer() = default;
  PartTracer(const PartTracer&) = delete;
  PartTracer& operator=(const PartTracer&) = delete;

  struct Parameters {
    Engine engine;
    TreeParameters tree{};
    int threads = 0;
    bool finds_all_hits = false;  ///< all_hits() may be called
  };
  /// `ids` ascend. `cuts`: of the whole set; null: all spheres are whole. The object must not move afterwards. Errors:
  /// as Tracer::build().
  Status make(const SphereSet& whole, std::shared_ptr<const CutSet> cuts, const std::vector<std::int64_t>& ids,
              const Parameters& parameters);

  /// As those of Tracer.
  Hit closest_hit(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const;
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* hidden) const;

  /// Each sphere that the ray's segment meets, at its t of a query for the closest hit: by t and then by id.
  void all_hits(const Ray& ray, std::vector<Crossing>& found) const;
  /// The same for many rays: by ray, t and id.
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const;

 private:
  // Some of the spheres as a set with its own ids.
  struct Balls {
    SphereSet spheres;
    std::vector<std::int64_t> ids;        // in the whole set
    std::vector<std::int64_t> own_place;  // of each sphere of the whole set: of an equal sphere here, or kNothing
    std::optional<Tracer> tracer;
    Tree tree;                           // only where it is needed
    std::vector<std::int64_t> by_place;  // the spheres here, ordered by centre and radius

    Status make(const SphereSet& whole, const Parameters& parameters, bool with_tree);
    std::int64_t place_of(Vec3d stored_centre, double stored_radius) const;
    std::int64_t whole_id(std::int64_t id) const { return ids[static_cast<std::size_t>(id)]; }
  };
  struct RayArrays {
    std::vector<std::int64_t> leaves;
    std::vector<std::uint8_t> inside, near_cut;
    std::vector<double> ends;
  };
  // Cut spheres with a tree of their balls.
  struct CutBalls : Balls {
    std::uint64_t common = ~std::uint64_t{0};  // the clips that cut all of them
    std::uint64_t any = 0;                     // the clips that cut some of them

    template <class Answer>
    void walk_with(Answer& answer) const;
  };
  struct NearestCut;
  struct AllCut;

  // The ray as these balls see it: it may leave one of them.
  Ray ray_to(const Balls& balls, const Ray& ray) const;
  RaySpan rays_to(const Balls& balls, const RaySpan& rays, RayArrays& arrays) const;
  static std::int64_t left_here(const Balls& balls, const CutRay& entered);
  RaySpan rays_to_look_at(const CutBalls& balls, const RaySpan& rays, const std::uint8_t* hidden,
                          RayArrays& arrays) const;
  Status make_cut(const SphereSet& whole, const std::vector<std::int64_t>& cut, const Parameters& parameters);
  // Calls use(i) for each ray i that may meet one of the balls. `hidden`: 1 for rays that need no look; may be null.
  template <class Use>
  void for_each_near(const CutBalls& balls, const RaySpan& rays, RayOrder order, const std::uint8_t* hidden,
                     const Use& use) const;
  template <class Answer>
  bool prepare(const CutBalls& balls, const Ray& ray, Answer& answer) const;
  void add_whole_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const;

  std::shared_ptr<const ImageTracer> images_;  // null: the set has no images. Else there are no cuts.
  std::shared_ptr<const CutSet> cuts_;
  Balls whole_;
  std::vector<std::unique_ptr<CutBalls>> cut_;  // by the clips that cut them; tracers refer to their spheres
};

}  // namespace bihive
