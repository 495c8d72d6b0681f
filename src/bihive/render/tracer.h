// One interface to all engines that answer ray queries on a sphere set.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/image/film.h"
#include "bihive/scene/camera.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

class RemoteEngine;
class RayEngine;
class CutSet;
struct EngineParameters;
class StickSet;
struct Scene;

/// automatic: the fastest engine, which is wide; wide: vectors on the wide tree (wide/queries.h); reference: scalar
/// traversal of the reference tree; brute: every sphere, one after the other; wide_brute: every sphere too, on vectors
/// (spans of rays; a single ray goes as with `brute`). All give the same bits.
enum class Engine { automatic, wide, reference, brute, wide_brute };

/// Whether its queries use vectors; the others are scalar references.
constexpr bool is_of_vectors(Engine engine) {
  return engine != Engine::reference && engine != Engine::brute;
}

/// It has no tree.
constexpr bool is_brute(Engine engine) {
  return engine == Engine::brute || engine == Engine::wide_brute;
}

/// The caller's limits for a tree, >= 1 or kUnlimited. Unset: the engine chooses; the reference builder then takes
/// leaves of at most 8 spheres and any depth.
struct TreeParameters {
  std::optional<std::int64_t> max_prims, max_depth;

  TreeParameters() = default;
  TreeParameters(std::optional<std::int64_t> prims, std::optional<std::int64_t> depth)
      : max_prims(prims), max_depth(depth) {}
  TreeParameters(const BuildParameters& both)  // NOLINT(google-explicit-constructor)
      : max_prims(both.max_prims), max_depth(both.max_depth) {}

  /// Unset limits become the reference builder's own choice.
  BuildParameters for_reference() const;
  /// For the wide builder. A limit that has no effect becomes 0.
  WideParameters for_wide(std::int64_t spheres) const;
};

/// Holds the structure of an engine, and refers to the spheres, which must outlive it. Queries are const, and any
/// number of threads may call them at a time. An invalid ray (geometry/ray.h) hits nothing. Copies share the structure.
class Tracer {
 public:
  /// Builds the structure of the engine on that many threads (0: all). A set with images (SphereSet::replicate) is
  /// traced with all of them: ids and bits are those of a set of copies. Errors: more spheres than the engine can
  /// number, or not enough memory for its tree.
  static Result<Tracer> build(const SphereSet& spheres, Engine engine, const TreeParameters& parameters = {},
                              int threads = 0);

  /// The same for a scene, whose clips (scene/clips.h) cut its spheres open, and whose sticks stand beside them.
  /// Without either it is the tracer of the scene's spheres, or of the walls of cavities. Error: check_sticks(), or
  /// either of them beside cavities. `first`: the number of spheres that
  /// are traced; rays may exit the others too; below 0: all. If that is not all, clips must cut some sphere.
  static Result<Tracer> build(const Scene& scene, Engine engine, const TreeParameters& parameters = {}, int threads = 0,
                              std::int64_t first = -1);

  /// A tracer on an existing tree of these spheres: for frame after frame with one WideBuilder (wide/wide_builder.h),
  /// or for several tracers on one tree.
  Tracer(const SphereSet& spheres, std::shared_ptr<const WideTree> tree);
  Tracer(const SphereSet& spheres, std::shared_ptr<const Tree> tree);

  /// A tracer that asks other processes. `seen`: the set to which they add the spheres that they tell of. One thread at
  /// a time may use it. `has_clips`: whether clips cut spheres of the whole set.
  Tracer(const SphereSet& seen, std::shared_ptr<RemoteEngine> remote, bool has_clips);

  /// One ray: the nearest hit, and whether there is any hit.
  Hit closest_hit(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

  /// Many rays at a time: much faster with the wide engine (wide/queries.h has the figures). Hit i belongs to ray i.
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const;
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const;

  /// Every sphere and stick that each ray meets, once, by ray, then by t, then by id. `found` is cleared first. t is
  /// that of closest_hit() for the body alone: the ray enters it there, or exits it if its segment begins inside.
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const;

  /// The hits of a camera's rays through the centres of a tile's pixels, row by row: hit i is that of pixel (x0 + i %
  /// width, y0 + i / width). The tile must lie inside the picture of `pixels`.
  void closest_hits(const PixelRays& pixels, const Tile& tile, const HitSpan& hits) const;

  Engine engine() const { return engine_; }  ///< never `automatic`
  const SphereSet& spheres() const { return *spheres_; }
  /// Whether clips cut the spheres. Then there is no tree of all spheres.
  bool has_clips() const { return has_clips_; }
  /// Whether there are sticks beside the spheres. Their ids follow those of the spheres (geometry/stick_set.h).
  bool has_sticks() const { return has_sticks_; }
  /// Whether it shows the walls of cavities (Scene::cavity_walls). Then there is no tree of all spheres.
  bool has_cavities() const { return has_cavities_; }
  /// Whether the spheres have images. Then a tree is that of the stored spheres alone.
  bool has_images() const { return has_images_; }
  const Tree* tree() const { return tree_; }                ///< null unless the engine is `reference`
  const WideTree* wide_tree() const { return wide_tree_; }  ///< null unless the engine is `wide`
  RemoteEngine* remote() const { return remote_.get(); }    ///< null: this process has all spheres
  double build_ms() const { return build_ms_; }             ///< 0 for a tree from elsewhere

 private:
  static Result<Tracer> of_cavities(const Scene& scene, const EngineParameters& parameters);
  static Result<Tracer> with_sticks(Tracer tracer, const StickSet& sticks, std::shared_ptr<const CutSet> cuts);
  Tracer(const SphereSet& spheres, Engine engine, std::shared_ptr<const RayEngine> rays);

  const SphereSet* spheres_;
  Engine engine_;
  std::shared_ptr<const RayEngine> rays_;  // the engine itself; it holds the trees
  const Tree* tree_;
  const WideTree* wide_tree_;
  std::shared_ptr<RemoteEngine> remote_;  // null: the spheres are here
  bool has_clips_ = false, has_images_ = false, has_sticks_ = false, has_cavities_ = false;
  double build_ms_ = 0;
};

}  // namespace bihive
