#include "bihive/render/picture/post_processing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/geometry/each_sphere.h"
#include "bihive/geometry/hit.h"
#include "bihive/scene/clips.h"

namespace bihive {
namespace {

constexpr double kBackgroundDepth = std::numeric_limits<double>::infinity();

// Edges of a cell are nearly black where nobody chose a colour; before a background that is darker than this, light.
constexpr double kDarkBackground = 0.18;
constexpr Vec3d kLightEdges{0.8, 0.8, 0.8};

std::optional<CellLines> cell_lines_of(const Scene& scene, const RenderSettings& settings) {
  if (settings.view != View::shaded || !settings.cell_lines) return std::nullopt;
  CellLines lines = *settings.cell_lines;
  const Vec3d& light = scene.background;
  const double brightness = 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z;
  if (lines.colour == CellLines().colour && !settings.transparent && brightness < kDarkBackground)
    lines.colour = kLightEdges;
  return lines;
}

}  // namespace

PostProcessing::PostProcessing(const Scene& scene, const WaveScene& wave_scene, const Tracer& tracer,
                               const RenderSettings& settings, const PixelRays& rays, const Transparency* transparency)
    : scene_(scene),
      wave_scene_(wave_scene),
      tracer_(tracer),
      rays_(rays),
      transparency_(transparency),
      cell_edges_(scene, cell_lines_of(scene, settings), settings.width_px, settings.height_px) {
  if (settings.view != View::shaded) return;
  outline_ = settings.outline;
  all_outlined_ = settings.outline.has_value();
  outline_scale_ = settings.outline_scale;
  fog_ = settings.fog;
  if (has_own_lines(scene) && !outline_) outline_.emplace();
  if (outline_) {
    double widest = 0;
    for (std::int64_t id = 0; id < scene.spheres.size(); ++id) widest = std::max(widest, line_of(id).width_px);
    border_ = static_cast<int>(std::ceil(widest));
    for (int y = -border_; y <= border_; ++y)
      for (int x = -border_; x <= border_; ++x)
        if ((x != 0 || y != 0) && x * x + y * y <= widest * widest) around_.push_back({x, y});
    if (around_.empty()) outline_.reset();
  }
  if (fog_) {
    nearest_ = kBackgroundDepth;
    const RemainingSpheres remaining(scene);
    const Vec3d eye = to_double(rays.eye());
    for_each_sphere(remaining.set(), [&](std::int64_t, Vec3d centre, double radius) {
      const double depth = dot(scene.spheres.to_local(centre) - eye, rays.forward());
      nearest_ = std::min(nearest_, depth - radius);
      farthest_ = std::max(farthest_, depth + radius);
    });
    nearest_ = std::min(std::max(nearest_, 0.0), farthest_);
  }
}

void PostProcessing::find(const Tile& tile, const std::vector<CameraSample>& camera_samples, const CancelToken* cancel,
                          EffectBuffers& buffers) const {
  const Tile grown{tile.x0 - border_, tile.y0 - border_, tile.x1 + border_, tile.y1 + border_};
  const std::int64_t row = grown.x1 - grown.x0;
  const std::int64_t width = tile.x1 - tile.x0;
  const std::size_t samples = camera_samples.size();
  buffers.effects.resize(static_cast<std::size_t>(width * (tile.y1 - tile.y0)) * samples);
  cell_edges_.find_near(tile, buffers.edges);
  for (std::size_t sample = 0; sample < samples; ++sample) {
    find_depths(grown, camera_samples[sample], cancel, buffers);
    if (cancel != nullptr && cancel->cancelled()) return;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::int64_t at = (y - grown.y0) * row + (x - grown.x0);
        SampleEffect& effect =
            buffers.effects[static_cast<std::size_t>((y - tile.y0) * width + (x - tile.x0)) * samples + sample];
        effect.outline = static_cast<float>(outline_at(buffers, at, row));
        double depth = buffers.depth[static_cast<std::size_t>(at)];
        if (!buffers.edges.empty()) {
          const SamplePlace place = camera_samples[sample].place;
          const double of_edge = cell_edges_.depth_at(buffers.edges, x + place.x, y + place.y);
          effect.cell_edge = of_edge < depth;
          depth = std::min(depth, of_edge);
        } else {
          effect.cell_edge = false;
        }
        effect.fog = static_cast<float>(fog_at(depth));
      }
  }
}

// The first hits through one place of each pixel. The rays are in blocks, as the queries for many rays like them.
void PostProcessing::find_depths(const Tile& grown, const CameraSample& sample, const CancelToken* cancel,
                                 EffectBuffers& buffers) const {
  const std::int64_t row = grown.x1 - grown.x0;
  const std::int64_t all = row * (grown.y1 - grown.y0);
  WaveBuffers& rays = buffers.rays;
  rays.reserve_positions(all);
  buffers.depth.resize(static_cast<std::size_t>(all));
  buffers.id.resize(static_cast<std::size_t>(all));
  buffers.place.resize(static_cast<std::size_t>(all));
  std::int64_t count = 0;
  for (int y0 = grown.y0; y0 < grown.y1; y0 += kBlockPx)
    for (int x0 = grown.x0; x0 < grown.x1; x0 += kBlockPx)
      for (int y = y0; y < std::min(y0 + kBlockPx, grown.y1); ++y)
        for (int x = x0; x < std::min(x0 + kBlockPx, grown.x1); ++x) {
          rays.x[count] = x + sample.place.x;
          rays.y[count] = y + sample.place.y;
          rays.lens_x[count] = sample.lens.x;
          rays.lens_y[count] = sample.lens.y;
          buffers.place[static_cast<std::size_t>(count)] =
              static_cast<std::int32_t>((y - grown.y0) * row + (x - grown.x0));
          ++count;
        }
  Wave& wave = WaveIntegrator::primaries(rays);
  wave.reset(count);
  wave.count = count;
  wave.starts_at_eye = true;
  steps::camera_rays(rays_, rays.positions(), wave);
  WaveIntegrator::Settings settings{1, false, false, false};
  settings.transparency = transparency_;
  WaveIntegrator integrator(wave_scene_, tracer_, settings, cancel);
  integrator.find_first_hits(rays);
  for (std::int64_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(buffers.place[static_cast<std::size_t>(i)]);
    buffers.id[at] = rays.id[i];
    const Vec3d direction{double(wave.direction[0][i]), double(wave.direction[1][i]), double(wave.direction[2][i])};
    buffers.depth[at] = rays.id[i] == kNothing ? kBackgroundDepth : rays.t[i] * dot(direction, rays_.forward());
  }
}

// In a preview, lines that would be thinner than a pixel are left out.
PostProcessing::Line PostProcessing::line_of(std::int64_t id) const {
  const SphereAttributes& attributes = scene_.spheres.attributes();
  const auto i = static_cast<std::size_t>(scene_.spheres.stored_id(id));
  const double own = attributes.outline_px.empty() ? -1 : double(attributes.outline_px[i]);
  const double outline = own >= 0 ? own : all_outlined_ ? outline_->width_px : 0;
  const double width = (outline > 0 || attributes.crease.empty() ? outline : Outline().width_px) * outline_scale_;
  return {width >= 1 ? width : 0, outline > 0};
}

std::int32_t PostProcessing::group(std::int64_t id) const {
  const std::vector<std::int32_t>& groups = scene_.spheres.attributes().crease;
  return groups.empty() || id < 0 ? 0 : groups[static_cast<std::size_t>(scene_.spheres.stored_id(id))];
}

double PostProcessing::outline_at(const EffectBuffers& buffers, std::int64_t at, std::int64_t row) const {
  const std::int64_t id = buffers.id[static_cast<std::size_t>(at)];
  if (!outline_ || id < 0) return 0;
  const Line line = line_of(id);
  if (!(line.width_px > 0)) return 0;
  const double depth = buffers.depth[static_cast<std::size_t>(at)];
  const double radius = scene_.spheres.radius(id);
  const double pixel = length(rays_.right()) * (rays_.parallel() ? 1 : depth);
  const double lines_wide = radius / (pixel * line.width_px);
  const double share = std::clamp((lines_wide - 2) / 4, 0.0, 1.0);
  if (!(share > 0)) return 0;
  const double limit = line.is_outline ? depth + outline_->step * radius : kBackgroundDepth;
  const bool beside_deeper = std::any_of(around_.begin(), around_.end(), [&](Step step) {
    if (step.x * step.x + step.y * step.y > line.width_px * line.width_px) return false;
    const auto at_beside = static_cast<std::size_t>(at + step.y * row + step.x);
    const std::int64_t beside = buffers.id[at_beside];
    if (beside == id) return false;
    const double its_depth = buffers.depth[at_beside];
    return its_depth > limit || (beside >= 0 && its_depth > depth && group(beside) != group(id));
  });
  return beside_deeper ? share : 0;
}

double PostProcessing::fog_at(double depth) const {
  if (!fog_ || depth == kBackgroundDepth) return 0;
  const double all = farthest_ - nearest_;
  const double share = all > 0 ? (depth - nearest_) / all : 0;
  return fog_->strength * std::clamp((share - fog_->start) / (fog_->end - fog_->start), 0.0, 1.0);
}

Vec3d PostProcessing::applied(const Tile& tile, const EffectBuffers& buffers, int x, int y, std::int64_t sample,
                              Vec3d light, double passing) const {
  const SampleEffect& effect = effect_of(tile, buffers, x, y, sample);
  if (effect.cell_edge) {
    light = (1 - passing) * light + passing * cell_edges_.colour();
  } else if (effect.outline > 0) {
    const double line = double(effect.outline) * passing;
    light = (1 - line) * light + line * outline_->colour;
  }
  if (effect.fog > 0) {
    const double fog = double(effect.fog) * passing;
    light = (1 - fog) * light + fog * scene_.background;
  }
  return light;
}

}  // namespace bihive
