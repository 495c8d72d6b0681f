#include "bihive/render/integrator.h"

#include <utility>

#include "bihive/render/shading.h"
#include "bihive/render/surface.h"

namespace bihive {

Vec3d Integrator::radiance(const Ray& primary, std::int64_t sample) {
  Vec3d sum;
  deepest_hit_ = 0;
  ++rays_.primary;
  generation_.assign(1, {primary, 1.0});
  for (int depth = 1; depth <= recursion_ && !generation_.empty(); ++depth) {
    next_.clear();
    // Rays that hit nothing.
    hits_.clear();
    for (const WeightedRay& item : generation_) {
      hits_.push_back(scene_hit(scene_, tracer_, item.ray));
      if (!hits_.back().found()) sum = sum + item.weight * scene_.background;
    }

    // Rays that hit a surface.
    for (std::size_t i = 0; i < generation_.size(); ++i) {
      if (!hits_[i].found()) continue;
      const WeightedRay& item = generation_[i];
      deepest_hit_ = depth;
      const Surface surface = surface_at(scene_, item.ray, hits_[i]);
      double visibility = 1;
      if (ambient_ != nullptr)
        visibility = ambient_visibility(scene_, tracer_, surface, ambient_->sets.of_sample(sample), ambient_->distance,
                                        rays_.ambient);
      const std::vector<Vec3d>* points = light_points_ != nullptr ? &light_points_->of_sample(sample) : nullptr;
      sum = sum + item.weight * local_light(scene_, tracer_, surface, shadows_, points, visibility, rays_.shadow);

      // Follow the reflected and the transmitted light; a share of exactly 0 makes no ray.
      if (depth == recursion_) continue;
      if (surface.material.reflective != 0) {
        ++rays_.reflected;
        next_.push_back({reflected_ray(surface), item.weight * surface.material.reflective});
      }
      if (surface.material.transmissive != 0) {
        ++rays_.transmitted;
        next_.push_back({transmitted_ray(surface), item.weight * surface.material.transmissive});
      }
    }
    std::swap(generation_, next_);
  }
  return sum;
}

}  // namespace bihive
