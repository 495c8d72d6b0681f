// Embree as a peer: the same spheres as points with radii, the same rays, in Embree's fastest mode.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "ray_sets.h"
#include "tiles.h"

namespace bihive::bench {

/// How Embree gets its rays: one at a time or in packets, with or without its flag for coherent rays.
struct EmbreeMode {
  int width;  ///< 1, 4, 8 or 16
  bool coherent;

  std::string name() const { return std::to_string(width) + (coherent ? " coherent" : ""); }
};

/// Rays in Embree's own layout, and their answers.
class EmbreeRays {
 public:
  virtual ~EmbreeRays() = default;
  /// Answers every ray of the given tiles, and returns the milliseconds. First it resets the fields of a ray that
  /// Embree changes (its end, its hit); that reset counts.
  virtual double trace_ms(RTCScene scene, bool coherent, int threads, const Tiles& tiles) = 0;
  /// Ids of closest hits (kNothing: none), or 1 and 0 for any hit, in the order of the ray set.
  virtual std::vector<std::int64_t> answers() const = 0;
};

class Embree {
 public:
  /// Restricted to the instruction set of `target` (simd/target.h) if Embree has it. Error: Embree cannot start.
  static Result<std::unique_ptr<Embree>> start(const SphereSet& spheres, int threads, const std::string& target);
  ~Embree();
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  static std::string version();

  /// Milliseconds of a scene made from nothing. The scene stays for queries.
  double build_fresh_ms();
  /// Milliseconds of building the same scene again after all spheres have changed.
  double rebuild_ms();
  /// The memory of the scene, and 16 bytes per sphere.
  std::int64_t bytes() const { return scene_bytes_ + 16 * sphere_count_; }

  std::unique_ptr<EmbreeRays> prepare(const RaySet& set, int width) const;
  double trace_ms(EmbreeRays& rays, bool coherent, const Tiles& tiles) const {
    return rays.trace_ms(scene_, coherent, threads_, tiles);
  }
  /// The sphere that Embree names for one ray: its occluder. kNothing: none.
  std::int64_t closest(const Ray& ray) const;

 private:
  Embree() = default;
  float start_of(const Ray& ray) const;

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;
  std::vector<float> points_;  // x, y, z, r in world units
  std::int64_t sphere_count_ = 0;
  int threads_ = 1;
  std::atomic<std::int64_t> held_bytes_{0};
  std::int64_t scene_bytes_ = 0;
};

}  // namespace bihive::bench
