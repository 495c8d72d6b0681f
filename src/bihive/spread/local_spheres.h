// One rank's spheres: their trees, and answers to other ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/opacity_rule.h"
#include "bihive/spread/ray_messages.h"
#include "bihive/spread/sphere_columns.h"

namespace bihive {

/// Const after make(); any number of threads may ask at a time.
class LocalSpheres {
 public:
  LocalSpheres() = default;
  LocalSpheres(const LocalSpheres&) = delete;
  LocalSpheres& operator=(const LocalSpheres&) = delete;

  /// `spheres`: a scene with this rank's spheres, `count` of them, which ascend by `whole_ids`; then, where clips cut
  /// some sphere of the whole set, those of other ranks on which rays may start and that matter here, ascending too.
  /// Errors: as Tracer::build().
  static Result<std::shared_ptr<const LocalSpheres>> make(Scene spheres, std::vector<std::int64_t> whole_ids,
                                                          std::int64_t count, const SphereColumns& has,
                                                          OpacityRule rule, const TreeParameters& parameters,
                                                          int threads);

  std::int64_t size() const { return count_; }
  double build_ms() const { return tracer_->build_ms(); }

  /// The answer to any question of RankChannel.
  Bytes answer(const Bytes& question) const;

  /// The same for questions and answers that stay on this rank. `rays.leaves`: positions.
  void closest_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, std::vector<FoundSphere>& found) const;
  void occluded(WhichSpheres which, const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const;
  void all_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, std::vector<FoundSphere>& found) const;
  void pack(const std::vector<std::int64_t>& places, Bytes& bytes) const;
  /// The position of another rank's sphere, or kNothing if it does not matter here.
  std::int64_t place_of_ghost(std::int64_t whole_id) const;

 private:
  FoundSphere found_sphere(std::int64_t ray, double t, std::int64_t place) const {
    return {ray, t, whole_ids_[static_cast<std::size_t>(place)], static_cast<Place>(place)};
  }

  std::int64_t count_ = 0;
  Scene scene_;
  std::vector<std::int64_t> whole_ids_;
  SphereColumns has_;
  std::optional<Tracer> tracer_;
  Transparency transparency_;
};

}  // namespace bihive
