// Outlines, fog and cell edges of settings/picture_effects.h, sample by sample.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/render/picture/cell_edges.h"
#include "bihive/render/shade/wave/wave_integrator.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/lens_pattern.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// What becomes of one sample's light.
struct SampleEffect {
  float outline = 0;       ///< the share of the outline's colour
  float fog = 0;           ///< the share of the background
  bool cell_edge = false;  ///< an edge of the cell stands before it
};

/// Buffers that a thread keeps from tile to tile.
struct EffectBuffers {
  WaveBuffers rays;
  std::vector<double> depth;  ///< of a tile with its border, row by row; +inf: background
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> run;    ///< how many neighbours at either side hit the same, at most the border's width
  std::vector<std::int32_t> place;  ///< in `depth`, of each ray
  std::vector<SampleEffect> effects;
  std::vector<EdgeOnPicture> edges;  ///< of cells, near the tile
};

class PostProcessing {
 public:
  /// All but the settings must outlive it. Outlines and fog look through what `transparency` lets straight through.
  PostProcessing(const Scene& scene, const WaveScene& wave_scene, const Tracer& tracer, const RenderSettings& settings,
                 const PixelRays& rays, const Transparency* transparency);

  /// Whether the settings ask for any.
  bool any() const { return outline_ || fog_ || cell_edges_.any(); }

  /// Whether an edge of the cell shows in a sample: then it covers its place also where nothing is hit.
  bool is_cell_edge(const Tile& tile, const EffectBuffers& buffers, int x, int y, std::int64_t sample) const {
    return cell_edges_.any() && effect_of(tile, buffers, x, y, sample).cell_edge;
  }

  /// Looks at the first hits of all samples of the tile and of the pixels around it, which are rays of their own also
  /// beyond the picture's edge; so each pixel is the same in every tile.
  void find(const Tile& tile, const std::vector<CameraSample>& samples, const CancelToken* cancel,
            EffectBuffers& buffers) const;

  /// The light of sample `sample` of a pixel of the tile of the last find(). `passing`: the share of light that passes
  /// what is transparent before the surface to which outline and fog belong.
  Vec3d applied(const Tile& tile, const EffectBuffers& buffers, int x, int y, std::int64_t sample, Vec3d light,
                double passing = 1) const;

 private:
  void find_depths_of_set(int threads);
  void find_depths(const Tile& grown, const CameraSample& sample, const CancelToken* cancel,
                   EffectBuffers& buffers) const;
  void find_runs(std::int64_t row, EffectBuffers& buffers) const;
  double outline_at(const EffectBuffers& buffers, std::int64_t at, std::int64_t row) const;
  double fog_at(double depth) const;
  static const SampleEffect& effect_of(const Tile& tile, const EffectBuffers& buffers, int x, int y,
                                       std::int64_t sample) {
    const std::int64_t width = tile.x1 - tile.x0;
    const auto pixel = static_cast<std::size_t>((y - tile.y0) * width + (x - tile.x0));
    const std::size_t samples = buffers.effects.size() / static_cast<std::size_t>(width * (tile.y1 - tile.y0));
    return buffers.effects[pixel * samples + static_cast<std::size_t>(sample)];
  }

  const Scene& scene_;
  const WaveScene& wave_scene_;
  const Tracer& tracer_;
  const PixelRays& rays_;
  const Transparency* transparency_;
  // Of one sphere: how wide its lines are, and whether one runs along its whole outline or only where it touches
  // another group.
  struct Line {
    double width_px;
    bool is_outline;
  };
  Line line_of(std::int64_t id) const;
  std::int32_t group(std::int64_t id) const;

  std::optional<Outline> outline_;
  bool all_outlined_ = false;
  double line_unit_px_ = 1;
  std::optional<Fog> fog_;
  double nearest_ = 0, farthest_ = 0;  // depths of the set
  CellEdges cell_edges_;
  int border_ = 0;  // the pixels around a tile that its lines look at
};

}  // namespace bihive
