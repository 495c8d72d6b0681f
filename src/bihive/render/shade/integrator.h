// The light along one primary ray. It follows generation after generation of reflected and transmitted rays.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/render/ray_counts.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/ambient_occlusion.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/light_points.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Keeps its lists between calls; each thread needs its own.
class Integrator {
 public:
  /// `ambient`, `light_points` and `transparency` must outlive it; null: no ambient occlusion, no soft shadows,
  /// OpacityRule::each_surface.
  Integrator(const Scene& scene, const Tracer& tracer, int recursion, bool shadows,
             const AmbientRays* ambient = nullptr, const LightPointSets* light_points = nullptr,
             const Transparency* transparency = nullptr)
      : scene_(scene),
        tracer_(tracer),
        recursion_(recursion),
        shadows_(shadows),
        ambient_(ambient),
        light_points_(light_points),
        to_eye_(transparency != nullptr ? transparency->to_eye.get() : nullptr),
        paths_(tracer, transparency != nullptr ? transparency->to_light.get() : nullptr),
        cuts_(cut_set_of(scene)) {}

  /// The sum has a fixed order, so that every engine can give the same bits: generation by generation. In a generation
  /// the rays that hit nothing come first and add weight x background; then come the surfaces of all rays. Both follow
  /// the order of the parents, the reflected ray of a parent before the transmitted one.
  /// Transparent spheres (OpacityRule::once) that a ray crosses are surfaces of its own generation, the nearest first.
  /// Each multiplies the ray's weight and tint for what is behind it. Light counts times weight times tint.
  /// `sample`: the number of the ray in its pixel.
  Vec3d radiance(const Ray& primary, std::int64_t sample = 0);

  /// The deepest generation with a ray that hit something in the last call; 0 if no ray did.
  int deepest_hit() const { return deepest_hit_; }
  const RenderCounts& rays() const { return rays_; }

 private:
  // The share of light along the ray, and the colour of what lies on its way to the eye.
  struct WeightedRay {
    Ray ray;
    double weight;
    Vec3d tint;
  };
  // A surface that a ray of the generation meets, and the weight and tint with which it gets there.
  struct WeightedHit {
    std::size_t ray;
    SceneHit hit;
    double weight;
    Vec3d tint;
  };

  void find_hits(std::size_t ray, Vec3d& sum);
  bool is_followed(double weight) const { return to_eye_ == nullptr || weight >= kFaintestRay; }

  const Scene& scene_;
  const Tracer& tracer_;
  int recursion_;
  bool shadows_;
  const AmbientRays* ambient_;
  const LightPointSets* light_points_;
  const TransparentSpheres* to_eye_;
  LightPaths paths_;
  std::shared_ptr<const CutSet> cuts_;
  int deepest_hit_ = 0;
  RenderCounts rays_;
  std::vector<WeightedRay> generation_, next_;
  std::vector<WeightedHit> hits_;
  std::vector<Crossing> crossings_;
};

}  // namespace bihive
