// The light along many primary rays at once. It follows generation after generation of all of them together.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/render/ray_counts.h"
#include "bihive/render/shade/wave/wave.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/ambient_occlusion.h"
#include "bihive/scene/faint_level.h"
#include "bihive/scene/light_points.h"

namespace bihive {

/// The most rays of one generation that are traced together. A larger generation is cut between owners and finished
/// part by part. A single owner's rays are never cut (2^15 of them in generation 16).
constexpr std::int64_t kMostRaysAtOnce = 32768;

/// The surfaces that the rays of one generation meet, where there are transparent spheres.
struct CrossingBuffers {
  std::vector<double> end;           ///< of each ray: where it ends
  std::vector<std::int64_t> end_id;  ///< what ends it
  std::vector<RayHit> crossings;     ///< ray after ray
  std::vector<std::size_t> first;    ///< of each ray, in `crossings`; and their number
};

/// Answers of other processes about rays of places, before these rays' turn comes.
struct AnswersAhead {
  RayBatch rays;
  std::vector<std::uint8_t> hidden;
  Columns3<double> share;
  std::int64_t next = 0;  ///< the first ray whose turn is still to come

  bool any() const { return next < rays.size(); }
};

/// Buffers that a thread keeps from one piece of a picture to the next: some 100 bytes per ray of the largest
/// generation, and with ambient occlusion some 150 more.
struct WaveBuffers {
  std::vector<Wave> generations;
  std::vector<CrossingBuffers> crossings;  ///< of each generation
  Wave layers;                             ///< a ray for each surface, the same way as far as it
  Column<double> t;
  Column<std::int64_t> id;
  WaveSurfaces surfaces;
  ShadowWave shadows;
  Column<std::uint8_t> hidden;
  Columns3<double> share;
  steps::PlaceGroups groups;
  PlaceWave places;
  AnswersAhead ahead;
  Column<std::uint8_t> level;  ///< faint_level() of each surface; only where spheres are passed straight
  Column<double> limits;
  Columns3<double> visibility;
  Columns3<double> light_facing, light_seen;  ///< of LightReceived
  /// Of light that is shared: PlaceWave::in_front of each surface, and of each light with a radius.
  Column<double> in_front, light_in_front;
  steps::Neighbours neighbours;
  WaveSums sums;
  Column<double> x, y, lens_x, lens_y;  ///< of primary rays

  void reserve_positions(std::int64_t n) {
    for (Column<double>* column : {&x, &y, &lens_x, &lens_y}) column->reserve(n);
  }
  PicturePositions positions() const { return {x.data(), y.data(), lens_x.data(), lens_y.data()}; }
};

/// The same bits as Integrator (render/shade/integrator.h), ray for ray.
class WaveIntegrator {
 public:
  struct Settings {
    int recursion;
    bool light;    ///< the light of owners is summed up
    bool shadows;  ///< only with `light`
    bool depth;    ///< deepest_hit() and coverage() are known afterwards
    /// Ambient occlusion, only with `light`; null: none. It must outlive the integrator.
    const AmbientRays* ambient = nullptr;
    /// Soft shadows, only with `shadows`; null: none. It must outlive the integrator.
    const LightPointSets* light_points = nullptr;
    std::int64_t samples_per_pixel = 1;  ///< for `ambient` and `light_points`
    /// Null: OpacityRule::each_surface. It must outlive the integrator, and the WaveScene must know the same rule.
    const Transparency* transparency = nullptr;
    /// The background straight behind what primary rays cross is left out of the sums (coverage()).
    bool without_background = false;
    /// Each owner is a pixel, and neighbours share what the sets of directions and light points bring (steps::share()).
    bool shares_light = false;
  };
  WaveIntegrator(const WaveScene& scene, const Tracer& tracer, const Settings& settings, const CancelToken* cancel)
      : scene_(scene), tracer_(tracer), settings_(settings), cancel_(cancel) {}

  /// Follows the rays of primaries() to their end. Owners are 0 to owners - 1; owner 0 is sample `first_sample` of its
  /// pixel, the others follow. `pixel`: of each owner, only for light that is shared. After a cancel the result is
  /// undefined.
  void trace(WaveBuffers& buffers, std::int64_t owners, std::int64_t first_sample = 0,
             const PixelPlace* pixel = nullptr);

  /// Only the first hits of primaries(), on opaque spheres and the plane: t and id of ray i in buffers.t[i] and
  /// buffers.id[i].
  void find_first_hits(WaveBuffers& buffers);

  /// The caller fills them before trace().
  static Wave& primaries(WaveBuffers& buffers) {
    if (buffers.generations.empty()) buffers.generations.resize(1);
    return buffers.generations.front();
  }

  /// For each owner: the deepest generation with a ray that hit something in the last trace().
  const std::vector<std::uint8_t>& deepest_hit() const { return deepest_hit_; }
  /// For each owner of the last trace(): the share of light that passes all transparent spheres before the opaque one,
  /// the plane or the background.
  double passing(std::int64_t owner) const { return passing_.empty() ? 1 : passing_[static_cast<std::size_t>(owner)]; }
  /// The share of the picture that the owner's light covers: less than 1 only without_background, and where nothing but
  /// transparent spheres, or a shadow on a plane that shows nothing else, stands before it.
  double coverage(std::int64_t owner) const {
    const double covered = coverage_.empty() ? 1 : coverage_[static_cast<std::size_t>(owner)];
    return covered == kUncovered ? 0 : covered;
  }
  const RenderCounts& rays() const { return rays_; }

 private:
  template <class Ask>
  void for_each_span(const RaySpan& rays, const Ask& ask) const;
  void find_sphere_hits(const WavePart& rays, WaveBuffers& buffers) const;
  void trace_part(const WavePart& rays, int depth, WaveBuffers& buffers);
  bool find_crossings(const WavePart& rays, int depth, WaveBuffers& buffers) const;
  void trace_layers(const WavePart& rays, int depth, WaveBuffers& buffers);
  void put_layers(const WavePart& rays, const CrossingBuffers& found, std::int64_t first, std::int64_t end, int depth,
                  WaveBuffers& buffers);
  void put_layers_together(const WavePart& rays, const CrossingBuffers& found, std::int64_t first, std::int64_t end,
                           int depth, WaveBuffers& buffers);
  void follow(const WavePart& rays, int depth, WaveBuffers& buffers);
  void shade(const WavePart& rays, int depth, const HitSpan& hits, Wave* next, WaveBuffers& buffers);
  void find_levels(WaveBuffers& buffers) const;
  int levels() const { return to_eye() != nullptr ? kFaintLevels : 1; }
  void group_places(int sets, WaveBuffers& buffers) const;
  void find_shadows(int depth, WaveBuffers& buffers);
  void find_soft_shadows(int depth, WaveBuffers& buffers);
  void find_visibility(int depth, WaveBuffers& buffers);
  bool shares(int depth) const { return settings_.shares_light && depth == 1; }
  void share_light(WaveBuffers& buffers) const;
  template <class MakeRays, class Use>
  void trace_places_of_all(std::size_t count, int depth, double limit, WaveBuffers& buffers, const MakeRays& make,
                           const Use& use) const;
  RaySpan trace_places(int depth, double limit, WaveBuffers& buffers) const;
  void ask_for_light(const RaySpan& rays, RayOrder order, std::uint8_t* hidden, Columns3<double>& share,
                     std::int64_t first) const;
  const TransparentSpheres* to_eye() const {
    return settings_.transparency != nullptr ? settings_.transparency->to_eye.get() : nullptr;
  }
  const TransparentSpheres* to_light() const {
    return settings_.transparency != nullptr ? settings_.transparency->to_light.get() : nullptr;
  }
  // Whether the wave may hold layer after layer of many rays. Each owner must have a single ray, whose light is added
  // at the end of the generation: then the order of its own surfaces does not change.
  bool layers_go_together() const { return !scene_.spawns_rays && (with_shadows() || with_ambient()); }
  // Columns of what arrives from lights and surroundings: colours, if transparent spheres colour it.
  int channels() const { return to_light() != nullptr && to_light()->has_tints() ? 3 : 1; }
  bool is_soft(const PointLight& light) const { return settings_.light_points != nullptr && light.radius > 0; }
  bool with_shadows() const { return settings_.light && settings_.shadows; }
  bool with_ambient() const { return settings_.light && settings_.ambient != nullptr; }
  bool covers_by_shadows() const { return settings_.without_background && scene_.shadows_only; }
  bool cancelled() const { return cancel_ != nullptr && cancel_->cancelled(); }

  const WaveScene& scene_;
  const Tracer& tracer_;
  Settings settings_;
  const CancelToken* cancel_;
  RenderCounts rays_;
  std::int64_t first_sample_ = 0;
  const PixelPlace* pixel_ = nullptr;
  std::vector<std::uint8_t> deepest_hit_;
  std::vector<double> passing_, coverage_;  // empty: 1 of all
  static constexpr double kUncovered = -1;  // of an owner whose rays have hit nothing so far
};

}  // namespace bihive
