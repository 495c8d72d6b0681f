// Spheres that let light straight through, apart from those that end a ray: OpacityRule::once, first and as_one
// (settings/opacity_rule.h). So do sticks, with the shares of their spheres.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/optical_depth.h"
#include "bihive/math/vec3.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/material.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/opacity_rule.h"

namespace bihive {

class CutSet;
class RayEngine;
class RemoteEngine;
class StickSet;
struct DepthSums;

/// The colour that the light gets which goes straight through: white if all of it does, and the nearer to the hue of
/// the material, the less does. One channel is always 1, so that the transmissive share alone says how much gets
/// through; grey and black give white.
Vec3d passing_tint(const Material& material);

/// Where a ray crosses a transparent sphere or stick first: `t` of geometry/sphere.h. So a ray crosses a body once, on
/// its way in or, if it starts inside, on its way out; the one that it leaves outward it does not cross.
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

  /// What there is beside whole, uncoloured spheres that count one by one.
  struct Properties {
    /// Beside the spheres; null: none. In every list their halves follow the spheres. Both of a stick have the same
    /// share and class.
    const StickSet* sticks = nullptr;
    std::shared_ptr<const CutSet> cuts = nullptr;  ///< of the spheres (scene/clips.h); null: all are whole
    std::vector<Vec3d> tints = {};  ///< the colour that each share gets, as of passing_tint(); empty: none gets one
    /// The scene, if images have colours of their own (scene/image_colours.h); null: they have those of the stored
    /// spheres.
    const Scene* of_images = nullptr;
    std::int64_t first = -1;  ///< as for Tracer::build()
    /// Of each its opacity_class(), of which a ray crosses the first alone; -1: it is in none; empty: none is in one.
    std::vector<std::int8_t> classes = {};
    bool as_one = false;  ///< of a class it crosses the union instead, each time that it enters it
  };

  /// `passing`: of each sphere the share that it lets through, 0 to 1; 0: it is opaque. The trees are built for that
  /// engine on that many threads (0: all). The spheres, the sticks and that scene must outlive it. Error: not enough
  /// memory for a tree.
  static Result<std::shared_ptr<const TransparentSpheres>> divide(const SphereSet& spheres, std::vector<double> passing,
                                                                  Engine engine, int threads, Properties more);
  static Result<std::shared_ptr<const TransparentSpheres>> divide(const SphereSet& spheres, std::vector<double> passing,
                                                                  Engine engine, int threads) {
    return divide(spheres, std::move(passing), engine, threads, Properties());
  }

  /// The same where other processes hold the spheres: `scene` knows those that were seen so far. `to_eye`: for rays
  /// that see, else for rays that ask for light. Both must outlive it.
  static std::shared_ptr<const TransparentSpheres> remote(const Scene& scene, RemoteEngine& remote, bool to_eye,
                                                          bool has_tints, OpacityRule rule);

  double passing(std::int64_t id) const { return seen_ != nullptr ? passing_of_seen(id) : passing_[stored(id)]; }
  bool has_tints() const { return has_tints_; }
  Vec3d tint(std::int64_t id) const {
    if (!has_tints()) return {1, 1, 1};
    if (seen_ != nullptr) return tint_of(*seen_, id);
    if (of_images_ != nullptr && id >= stored_spheres_ && class_of(id) < 0) return tint_of(*of_images_, id);
    return tints_[stored(id)];
  }
  /// The share that a surface does not let through; 1 of the plane.
  double stopping(std::int64_t id) const { return id >= 0 ? 1 - passing(id) : 1; }
  bool is_transparent(std::int64_t id) const { return id >= 0 && passing(id) > 0; }

  Hit closest_opaque(const Ray& ray) const;
  /// All crossings of the ray's segment, by t and then by id; of a class the first.
  void find_crossings(const Ray& ray, std::vector<Crossing>& found) const;
  /// Transmittance along the ray: 0 behind an opaque sphere, else that of the sum of the optical depths
  /// (math/optical_depth.h) of the crossed spheres in no class, in each channel that of share times tint, times the
  /// share of the first sphere of each class, or of all that are crossed, in the order of the classes and along the
  /// ray.
  Vec3d share(const Ray& ray) const;

  /// Many rays at a time. Each ray's answer goes to its place, all crossings to one list: by ray, t and id. hides: 1
  /// behind an opaque sphere.
  void closest_opaque(const RaySpan& rays, RayOrder order, const HitSpan& hits) const;
  void hides(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const;
  void find_crossings(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const;
  /// The shares of rays that no opaque sphere hides, for each ray: in red, green and blue, or if there are no tints, in
  /// one column for all.
  void find_shares(const RaySpan& rays, RayOrder order, double* const columns[3]) const;

 private:
  // The row of a sphere or of half a stick, of an image that of what is stored.
  std::size_t stored(std::int64_t id) const {
    if (id < stored_spheres_) return static_cast<std::size_t>(id);
    if (id < all_spheres_) return static_cast<std::size_t>(id % stored_spheres_);
    const std::int64_t halves = static_cast<std::int64_t>(passing_.size()) - stored_spheres_;
    return static_cast<std::size_t>(stored_spheres_ + (id - all_spheres_) % halves);
  }

  Vec3d tint_of(const Scene& scene, std::int64_t id) const;
  int class_of(std::int64_t id) const;
  int columns() const { return has_tints() ? 3 : 1; }
  void find_depths(std::int64_t id, OpticalDepth* row) const;
  void sum_of_hits(const RaySpan& rays, RayOrder order, const DepthSums& sums, double* passed) const;
  void keep_first_of_classes(std::vector<RayHit>& found) const;
  double passing_of_seen(std::int64_t id) const;

  bool has_tints_ = false;
  bool nothing_is_opaque_ = false;                     // as far as is known
  std::int64_t stored_spheres_ = 0, all_spheres_ = 0;  // without and with images
  std::vector<double> passing_;                        // of each stored sphere, then of each half of a stored stick
  std::vector<Vec3d> tints_;                           // empty: all are white
  std::vector<OpticalDepth> depths_;  // a row for each of these, 0 of those in a class; empty: they are remote
  std::vector<std::int8_t> classes_;  // empty: no sphere is in one, or they are remote
  const SphereSet* spheres_ = nullptr;
  const StickSet* sticks_ = nullptr;  // null: there are none
  std::shared_ptr<const CutSet> cuts_;
  const Scene* of_images_ = nullptr;  // null: images have the tints of what is stored
  const Scene* seen_ = nullptr;       // of the spheres that were seen; null: all are here
  bool to_eye_ = false;               // where they are remote
  bool has_classes_ = false;          // the same
  std::shared_ptr<const RayEngine> opaque_, transparent_;
  // The other transparent ones, a class each.
  struct Class {
    int number;
    std::shared_ptr<const RayEngine> spheres;  // null: it has none
    bool has_sticks;
    double share;  // of all its bodies; 0: they differ
  };
  // The hits of rays on sticks in classes, of each class the first.
  void find_sticks_of_classes(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const;
  // Of each ray the first hit on a class. `of_sticks`: as found by find_sticks_of_classes().
  void find_first(const Class& one, const RaySpan& rays, RayOrder order, const std::vector<RayHit>& of_sticks,
                  HitBatch& hits) const;
  void find_entries(const RaySpan& rays, RayOrder order, std::vector<RayHit>& entries) const;
  std::vector<Class> of_classes_;
  std::shared_ptr<const RayEngine> sticks_of_classes_;  // one tree for all, because many may have few; null: no sticks
  std::shared_ptr<const RayEngine> unions_;             // the bodies of all classes, each a union; null: they are not
};

/// The parts of a scene's set for one picture.
struct Transparency {
  /// For rays that see: transparent is what is passed straight. Null: nothing is.
  std::shared_ptr<const TransparentSpheres> to_eye;
  /// For rays that ask for light: refracting spheres let it pass too. Null: no sphere does.
  std::shared_ptr<const TransparentSpheres> to_light;

  /// Both null with OpacityRule::each_surface. Error: not enough memory for the trees. `first`: as for Tracer::build().
  static Result<Transparency> of(const Scene& scene, OpacityRule rule, Engine engine, int threads,
                                 std::int64_t first = -1);
  /// With the engine of that tracer, or where that tracer asks.
  static Result<Transparency> of(const Scene& scene, OpacityRule rule, const Tracer& tracer, int threads);
};

/// The straight ways to light: what of it arrives at the end of a ray. Made from a tracer alone, spheres hide wholly.
class LightPaths {
 public:
  LightPaths(const Tracer& tracer,  // NOLINT(google-explicit-constructor)
             const TransparentSpheres* transparent = nullptr)
      : tracer_(tracer), transparent_(transparent) {}

  Vec3d share(const Ray& ray) const {
    if (transparent_ != nullptr) return transparent_->share(ray);
    return tracer_.occluded(ray) ? Vec3d{} : Vec3d{1, 1, 1};
  }

 private:
  const Tracer& tracer_;
  const TransparentSpheres* transparent_;
};

}  // namespace bihive
