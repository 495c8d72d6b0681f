// Spheres that let light straight through, apart from those that end a ray: OpacityRule::once (scene/opacity_rule.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/opacity_rule.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Where a ray crosses a transparent sphere first: `t` of geometry/sphere.h. So a ray crosses a sphere once, on its way
/// in or, if it starts inside, on its way out; the sphere that it leaves outward it does not cross.
struct Crossing {
  double t;
  std::int64_t id;
};

/// A set in two parts: opaque spheres end a ray, transparent ones let a share of it through. Ids are the whole set's.
/// Queries are const; any number of threads may call them at a time.
class TransparentSpheres {
 public:
  TransparentSpheres() = default;
  TransparentSpheres(const TransparentSpheres&) = delete;
  TransparentSpheres& operator=(const TransparentSpheres&) = delete;

  /// `passing`: of each sphere the share that it lets through, 0 to 1; 0: it is opaque. The trees are built for that
  /// engine on that many threads (0: all). Error: not enough memory for a tree.
  static Result<std::shared_ptr<const TransparentSpheres>> divide(const SphereSet& spheres, std::vector<double> passing,
                                                                  Engine engine, int threads);

  double passing(std::int64_t id) const { return passing_[static_cast<std::size_t>(id)]; }
  bool is_transparent(std::int64_t id) const { return id >= 0 && passing(id) > 0; }

  Hit closest_opaque(const Ray& ray) const;
  /// All crossings of the ray's segment, by t and then by id.
  void find_crossings(const Ray& ray, std::vector<Crossing>& found) const;
  /// What arrives at the ray's end: 0 behind an opaque sphere, else the product of what the crossed spheres let
  /// through, in the order of the crossings.
  double share(const Ray& ray) const;

  /// Many rays at a time. Each ray's answer goes to its place, all crossings to one list: by ray, t and id. hides: 1
  /// behind an opaque sphere.
  void closest_opaque(const RaySpan& rays, RayOrder order, const HitSpan& hits) const;
  void hides(const RaySpan& rays, RayOrder order, std::uint8_t* hidden) const;
  void find_crossings(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const;

 private:
  // One part of the set, with its own ids.
  struct Part {
    SphereSet spheres;
    std::vector<std::int64_t> ids;        // in the whole set
    std::vector<std::int64_t> own_place;  // of each sphere of the whole set: of an equal sphere here, or kNothing
    std::optional<Tracer> tracer;

    Status make(const SphereSet& whole, Engine engine, int threads);
    std::int64_t left_here(std::int64_t leaves) const {
      const bool is_sphere = leaves >= 0 && leaves < static_cast<std::int64_t>(own_place.size());
      return is_sphere ? own_place[static_cast<std::size_t>(leaves)] : kNothing;
    }
    RaySpan rays_here(const RaySpan& rays, std::vector<std::int64_t>& leaves) const;
  };

  std::vector<double> passing_;
  Part opaque_, transparent_;
  Tree tree_;  // of the transparent ones
};

/// The parts of a scene's set for one picture.
struct Transparency {
  /// For rays that see: transparent is what is passed straight. Null: nothing is.
  std::shared_ptr<const TransparentSpheres> to_eye;
  /// For rays that ask for light: refracting spheres let it pass too. Null: no sphere does.
  std::shared_ptr<const TransparentSpheres> to_light;

  /// Both null with OpacityRule::each_surface. Error: not enough memory for the trees.
  static Result<Transparency> of(const Scene& scene, OpacityRule rule, Engine engine, int threads);
};

/// The straight ways to light: what of it arrives at the end of a ray. Made from a tracer alone, spheres hide wholly.
class LightPaths {
 public:
  LightPaths(const Tracer& tracer,  // NOLINT(google-explicit-constructor)
             const TransparentSpheres* transparent = nullptr)
      : tracer_(tracer), transparent_(transparent) {}

  double share(const Ray& ray) const {
    if (transparent_ != nullptr) return transparent_->share(ray);
    return tracer_.occluded(ray) ? 0 : 1;
  }

 private:
  const Tracer& tracer_;
  const TransparentSpheres* transparent_;
};

}  // namespace bihive
