#include "bihive/render/picture/post_processing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/base/parallel.h"
#include "bihive/geometry/hit.h"
#include "bihive/scene/clips.h"

namespace bihive {
namespace {

constexpr double kBackgroundDepth = std::numeric_limits<double>::infinity();

constexpr std::int64_t kSpheresAtOnce = 1 << 14;

// The radius of a sphere, in widths of its line at most as wide.
constexpr double kRadiusInLines = 6;

// Edges of a cell are nearly black where nobody chose a colour; before a background that is darker than this, light.
constexpr double kDarkBackground = 0.18;
constexpr Vec3d kLightEdges{0.8, 0.8, 0.8};

std::optional<CellLines> cell_lines_of(const Scene& scene, const RenderSettings& settings) {
  if (settings.view != View::shaded || !settings.cell_lines) return std::nullopt;
  CellLines lines = *settings.cell_lines;
  lines.width_px *= line_unit_px(settings);
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
      cell_edges_(scene, picture_camera(scene, settings), cell_lines_of(scene, settings), settings.width_px,
                  settings.height_px) {
  if (settings.view != View::shaded) return;
  outline_ = settings.outline;
  all_outlined_ = settings.outline.has_value();
  line_unit_px_ = line_unit_px(settings) * settings.line_scale;
  fog_ = settings.fog;
  if (has_own_lines(scene) && !outline_) outline_.emplace();
  if (outline_) {
    const SphereAttributes& attributes = scene.spheres.attributes();
    const bool are_alike = attributes.outline_px.empty();
    double widest = 0;
    for (std::int64_t id = 0; id < (are_alike ? std::min<std::int64_t>(1, scene.spheres.size()) : scene.spheres.size());
         ++id)
      widest = std::max(widest, line_of(id).width_px);
    border_ = widest > 0 ? static_cast<int>(std::max(widest, 1.0)) : 0;
    if (border_ == 0) outline_.reset();
  }
  if (fog_) {
    find_depths_of_set(settings.threads);
    nearest_ = std::min(std::max(nearest_, 0.0), farthest_);
  }
}

void PostProcessing::find_depths_of_set(int threads) {
  nearest_ = kBackgroundDepth;
  const RemainingSpheres remaining(scene_);
  const SphereSet& spheres = remaining.set();
  const Vec3d eye = to_double(rays_.eye()), forward = rays_.forward();
  const double unit = spheres.inverse_scale();
  struct Depths {
    double nearest = kBackgroundDepth, farthest = 0;
  };
  std::vector<Depths> parts(static_cast<std::size_t>((spheres.size() + kSpheresAtOnce - 1) / kSpheresAtOnce));
  parallel_for(threads, static_cast<std::int64_t>(parts.size()), [&](std::int64_t part) {
    Depths all;
    const std::int64_t end = std::min(spheres.size(), (part + 1) * kSpheresAtOnce);
    for (std::int64_t copy = 0; copy < spheres.images().count(); ++copy) {
      const Vec3d shift = copy == 0 ? Vec3d{} : spheres.scale() * spheres.images().shift(copy);
      for (std::int64_t id = part * kSpheresAtOnce; id < end; ++id) {
        Vec3d stored = spheres.stored_centre(id);
        if (copy > 0) stored = to_double(to_float(stored + shift));
        const Vec3d centre = spheres.in_world(stored * unit);
        const double radius = spheres.stored_radius(id) * unit;
        const double depth = dot(scene_.spheres.to_local(centre) - eye, forward);
        all.nearest = std::min(all.nearest, depth - radius);
        all.farthest = std::max(all.farthest, depth + radius);
      }
    }
    parts[static_cast<std::size_t>(part)] = all;
  });
  for (const Depths& part : parts) {
    nearest_ = std::min(nearest_, part.nearest);
    farthest_ = std::max(farthest_, part.farthest);
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
    if (outline_) find_runs(row, buffers);
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
    // Fog and outlines do not know a plane that shows shadows alone.
    if (wave_scene_.shadows_only && rays.id[i] == kPlane) rays.id[i] = kNothing;
    // Both halves of a stick are one thing.
    const std::int64_t half = rays.id[i] - scene_.spheres.total_size();
    if (half >= 0) rays.id[i] -= half % 2;
    buffers.id[at] = rays.id[i];
    const Vec3d direction{double(wave.direction[0][i]), double(wave.direction[1][i]), double(wave.direction[2][i])};
    buffers.depth[at] = rays.id[i] == kNothing ? kBackgroundDepth : rays.t[i] * dot(direction, rays_.forward());
  }
}

// How many neighbours at either side, up to the border's width, hit the same.
void PostProcessing::find_runs(std::int64_t row, EffectBuffers& buffers) const {
  const std::vector<std::int64_t>& id = buffers.id;
  const auto width = static_cast<std::size_t>(row);
  buffers.run.assign(id.size(), 0);
  std::vector<std::uint8_t>& run = buffers.run;
  for (std::size_t begin = 0; begin < id.size(); begin += width) {
    const std::size_t end = begin + width;
    for (std::size_t at = begin; at < end;) {
      std::size_t next = at + 1;
      while (next < end && id[next] == id[at]) ++next;
      for (std::size_t inside = at; inside < next; ++inside)
        run[inside] =
            static_cast<std::uint8_t>(std::min({inside - at, next - 1 - inside, static_cast<std::size_t>(border_)}));
      at = next;
    }
  }
}

PostProcessing::Line PostProcessing::line_of(std::int64_t id) const {
  const SphereAttributes& attributes = scene_.spheres.attributes();
  const auto i = static_cast<std::size_t>(scene_.spheres.stored_id(shown_sphere(scene_, id)));
  const double own = attributes.outline_px.empty() ? -1 : double(attributes.outline_px[i]);
  const double outline = own >= 0 ? own : all_outlined_ ? outline_->width_px : 0;
  const double width = (outline > 0 || attributes.crease.empty() ? outline : Outline().width_px) * line_unit_px_;
  return {std::min(width, kWidestLinePx), outline > 0};
}

std::int32_t PostProcessing::group(std::int64_t id) const {
  const std::vector<std::int32_t>& groups = scene_.spheres.attributes().crease;
  return groups.empty() || id < 0
             ? 0
             : groups[static_cast<std::size_t>(scene_.spheres.stored_id(shown_sphere(scene_, id)))];
}

double PostProcessing::outline_at(const EffectBuffers& buffers, std::int64_t at, std::int64_t row) const {
  const std::int64_t id = buffers.id[static_cast<std::size_t>(at)];
  if (!outline_ || id < 0) return 0;
  const Line line = line_of(id);
  if (!(line.width_px > 0)) return 0;
  const double depth = buffers.depth[static_cast<std::size_t>(at)];
  const double radius =
      id < scene_.spheres.total_size()
          ? scene_.spheres.radius(id)
          : scene_.sticks.stored_radius((id - scene_.spheres.total_size()) / 2) * scene_.spheres.inverse_scale();
  const double pixel = length(rays_.right()) * (rays_.parallel() ? 1 : depth);
  const double width = std::min(line.width_px, radius / (kRadiusInLines * pixel));
  const double reach = std::max(width, 1.0);
  const double limit = line.is_outline ? depth + outline_->step * radius : kBackgroundDepth;
  const auto is_edge_beside = [&](std::size_t at_beside) {
    const std::int64_t beside = buffers.id[at_beside];
    if (beside == id) return false;
    const double its_depth = buffers.depth[at_beside];
    return its_depth > limit || (beside >= 0 && its_depth > depth && group(beside) != group(id));
  };

  // Look at the circle around the sample, row by row; a row that hits the same sphere from end to end has no edge.
  const auto rows = static_cast<std::int64_t>(reach);
  for (std::int64_t y = -rows; y <= rows; ++y) {
    const auto across = static_cast<std::int64_t>(std::sqrt(reach * reach - static_cast<double>(y * y)));
    const std::int64_t middle = at + y * row;
    const auto i = static_cast<std::size_t>(middle);
    if (buffers.id[i] == id && buffers.run[i] >= across) continue;
    for (std::int64_t beside = middle - across; beside <= middle + across; ++beside)
      if (is_edge_beside(static_cast<std::size_t>(beside))) return std::min(width, 1.0);
  }
  return 0;
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
    const double line = cell_edges_.opacity() * passing;
    light = (1 - line) * light + line * cell_edges_.colour();
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
