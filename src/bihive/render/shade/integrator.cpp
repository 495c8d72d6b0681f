#include "bihive/render/shade/integrator.h"

#include <utility>

#include "bihive/render/shading.h"
#include "bihive/render/surface.h"

namespace bihive {

// The surfaces that a ray of the generation meets: transparent spheres, then what ends it. If nothing does, the
// background adds to the sum.
void Integrator::find_hits(std::size_t ray, Vec3d& sum) {
  const WeightedRay& item = generation_[ray];
  double weight = item.weight;
  Vec3d tint = item.tint;
  SceneHit end;
  if (to_eye_ == nullptr) {
    end = scene_hit(scene_, tracer_, item.ray);
  } else {
    end = scene_hit(scene_, to_eye_->closest_opaque(item.ray), item.ray);
    to_eye_->find_crossings(item.ray, crossings_);
    for (const Crossing& crossing : crossings_) {
      if (!(crossing.t < end.t)) break;
      if (is_followed(weight)) hits_.push_back({ray, {crossing.t, crossing.id}, weight, tint});
      weight = weight * to_eye_->passing(crossing.id);
      tint = tint * to_eye_->tint(crossing.id);
    }
  }
  if (end.found())
    hits_.push_back({ray, end, weight, tint});
  else
    sum = sum + (weight * tint) * scene_.background;
}

Vec3d Integrator::radiance(const Ray& primary, std::int64_t sample) {
  Vec3d sum;
  deepest_hit_ = 0;
  ++rays_.primary;
  generation_.assign(1, {primary, 1.0, {1, 1, 1}});
  for (int depth = 1; depth <= recursion_ && !generation_.empty(); ++depth) {
    next_.clear();
    hits_.clear();
    for (std::size_t i = 0; i < generation_.size(); ++i) find_hits(i, sum);

    for (const WeightedHit& item : hits_) {
      const Surface surface = surface_at(scene_, generation_[item.ray].ray, item.hit, cuts_.get());
      const bool shadows_only = surface.id == kPlane && scene_.plane->shadows_only;
      if (!shadows_only) deepest_hit_ = depth;
      const int level = to_eye_ != nullptr ? faint_level(item.weight * to_eye_->stopping(surface.id)) : 0;
      Vec3d visibility{1, 1, 1};
      if (ambient_ != nullptr)
        visibility = ambient_visibility(scene_, paths_, surface, ambient_->sets.of_sample(sample, level),
                                        ambient_->distance, rays_.ambient);
      const std::vector<Vec3d>* points = light_points_ != nullptr ? &light_points_->of_sample(sample, level) : nullptr;
      const auto light_of = shadows_only ? light_of_shadows_only : local_light;
      sum = sum +
            (item.weight * item.tint) * light_of(scene_, paths_, surface, shadows_, points, visibility, rays_.shadow);
      if (shadows_only) continue;

      // Follow the reflected and the transmitted light; a share of exactly 0 makes no ray, nor does a faint one.
      if (depth == recursion_) continue;
      const double reflected = item.weight * surface.material.reflective;
      if (surface.material.reflective != 0 && is_followed(reflected)) {
        ++rays_.reflected;
        next_.push_back({reflected_ray(surface), reflected, item.tint});
      }
      if (to_eye_ != nullptr && to_eye_->is_transparent(surface.id)) continue;
      const double transmitted = item.weight * surface.material.transmissive;
      if (surface.material.transmissive != 0 && is_followed(transmitted)) {
        ++rays_.transmitted;
        next_.push_back({transmitted_ray(surface), transmitted, item.tint});
      }
    }
    std::swap(generation_, next_);
  }
  return sum;
}

}  // namespace bihive
