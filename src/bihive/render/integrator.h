// The light along one primary ray: generation after generation of reflected and transmitted rays.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/render/renderer.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Keeps its lists between calls; one a thread.
class Integrator {
 public:
  Integrator(const Scene& scene, const Tracer& tracer, int recursion, bool shadows)
      : scene_(scene), tracer_(tracer), recursion_(recursion), shadows_(shadows) {}

  /// The sum is made in a fixed order, so that every engine can give the same bits: generation by generation; inside
  /// one, first the rays that hit nothing, which add weight x background, then the surfaces of the others; each in the
  /// order of the parents, of one parent's two the reflected first.
  Vec3d radiance(const Ray& primary);

  /// The deepest generation of which a ray hit something in the last call; 0 if none did.
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
  int deepest_hit_ = 0;
  RenderCounts rays_;
  std::vector<WeightedRay> generation_, next_;
  std::vector<SceneHit> hits_;
};

}  // namespace bihive
