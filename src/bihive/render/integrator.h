// The light along one primary ray. It follows generation after generation of reflected and transmitted rays.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/render/renderer.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/light_points.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Keeps its lists between calls; each thread needs its own.
class Integrator {
 public:
  /// `ambient` and `light_points` must outlive it; null: no ambient occlusion, no soft shadows.
  Integrator(const Scene& scene, const Tracer& tracer, int recursion, bool shadows,
             const AmbientRays* ambient = nullptr, const LightPointSets* light_points = nullptr)
      : scene_(scene),
        tracer_(tracer),
        recursion_(recursion),
        shadows_(shadows),
        ambient_(ambient),
        light_points_(light_points) {}

  /// The sum has a fixed order, so that every engine can give the same bits: generation by generation. In a generation
  /// the rays that hit nothing come first and add weight x background; then come the surfaces of the others. Both
  /// follow the order of the parents, the reflected ray of a parent before the transmitted one.
  /// `sample`: the number of the ray in its pixel.
  Vec3d radiance(const Ray& primary, std::int64_t sample = 0);

  /// The deepest generation with a ray that hit something in the last call; 0 if no ray did.
  int deepest_hit() const { return deepest_hit_; }
  const RenderCounts& rays() const { return rays_; }

 private:
  struct WeightedRay {
    Ray ray;
    double weight;
  };

  const Scene& scene_;
  const Tracer& tracer_;
  int recursion_;
  bool shadows_;
  const AmbientRays* ambient_;
  const LightPointSets* light_points_;
  int deepest_hit_ = 0;
  RenderCounts rays_;
  std::vector<WeightedRay> generation_, next_;
  std::vector<SceneHit> hits_;
};

}  // namespace bihive
