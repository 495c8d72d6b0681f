// The state of an unfinished picture: its tiles, which threads share, in one pass or two.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "bihive/render/picture/edge_pixels.h"
#include "bihive/render/picture/post_processing.h"
#include "bihive/render/query/pixel_order.h"
#include "bihive/render/renderer.h"
#include "bihive/render/shade/wave/wave_integrator.h"
#include "bihive/render/views.h"
#include "bihive/scene/lens_pattern.h"

namespace bihive {

class Drawing {
 public:
  /// Errors: settings that the tracer cannot draw, and no memory for trees of transparent spheres. Scene and tracer
  /// must outlive it.
  static Result<std::unique_ptr<Drawing>> begin(const Scene& scene, const Tracer& tracer,
                                                const RenderSettings& settings, const ProgressCallback& progress = {},
                                                const CancelToken* cancel = nullptr);

  /// These pixels of the picture are next. Takes the memory of `film`. Error: it needs more than there is.
  Status start(const Tile& part, Film film);

  /// The tiles of all passes have consecutive numbers. Draws those from `first` to before `end`, all of one pass.
  void run(std::size_t first, std::size_t end);
  /// The same for callers with threads of their own: before the tile `first` of a pass and those after it, and then
  /// each, by any thread.
  void begin_pass(std::size_t first);
  void run_tile(std::size_t tile);
  std::size_t tiles_in_a_pass() const { return tiles_.size(); }
  std::size_t tiles_in_all() const { return passes_ * tiles_.size(); }

  /// Draws all tiles of the part.
  void run_all();
  /// After the last tile: the part. An Error if it was cancelled.
  Result<Rendered> take();

 private:
  // The samples of a pixel, and the directions and points that they take.
  struct SampleSet {
    SampleSet(const Scene& scene, const RenderSettings& settings, int count, bool shares_light);
    std::int64_t count() const { return static_cast<std::int64_t>(places.size()); }

    std::vector<CameraSample> places;
    std::optional<AmbientRays> ambient;
    std::optional<LightPointSets> light_points;
    int light_sets;  // that pixels share (RenderSettings)
  };
  struct PixelSum;

  Drawing(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, const ProgressCallback& progress,
          const CancelToken* cancel, Transparency transparency);

  bool cancelled() const { return cancel_ != nullptr && cancel_->cancelled(); }
  void report_progress();
  void begin_second_pass();
  void find_distance_range(std::size_t tile);
  void draw_tile(const Tile& tile, RenderCounts& counts);
  void refine_tile(const Tile& tile, RenderCounts& counts);
  void draw_tree();

  template <class Use>
  void for_each_wave(const std::vector<PixelPlace>& pixels, std::int64_t pixel_count, const SampleSet& set,
                     const Use& use) const;
  void make_primaries(const std::vector<PixelPlace>& pixels, std::int64_t first, std::int64_t count,
                      const SampleSet& set, WaveBuffers& buffers) const;
  void draw_pixels(const Tile& tile, const std::vector<PixelPlace>& pixels, std::int64_t pixel_count,
                   const SampleSet& set, RenderCounts& counts);
  bool hits_something(const WaveBuffers& buffers, const WaveIntegrator& integrator, std::int64_t i) const;
  Vec3d sample_value(WaveBuffers& buffers, const WaveIntegrator& integrator, std::int64_t i) const;
  void put(const PixelSum& sum, PixelPlace pixel);

  const Scene& scene_;
  const Tracer& tracer_;
  RenderSettings settings_;
  ProgressCallback progress_;
  const CancelToken* cancel_;
  Film film_;
  PixelRays rays_;
  Transparency transparency_;
  WaveScene wave_scene_;
  PostProcessing post_processing_;
  Tile drawn_{};  // the film's pixels in the whole picture
  std::vector<Tile> tiles_;
  std::vector<RenderCounts> counts_;  // of each tile
  std::vector<DistanceRange> ranges_;
  DistanceRange range_{0, 0};
  std::size_t passes_;
  SampleSet first_set_;
  std::optional<SampleSet> second_set_;  // of the second pass of adaptive samples
  EdgePixels edges_;
  std::optional<Error> failure_;  // of the drawing of a tree
  std::atomic<std::int64_t> tiles_done_{0};
  std::mutex progress_mutex_;
};

}  // namespace bihive
