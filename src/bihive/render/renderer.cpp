#include "bihive/render/renderer.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/render/after_effects.h"
#include "bihive/render/pixel_order.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tree_picture.h"
#include "bihive/render/views.h"
#include "bihive/render/wave/wave_integrator.h"
#include "bihive/scene/sample_pattern.h"

namespace bihive {
namespace {

// Tiles of the wide engine are large enough for its vectors and small enough for the cache. The other engines need
// neither.
constexpr int kTilePx = 64;
constexpr int kScalarTilePx = 16;

// Outlines and fog keep something for each sample of a tile, so there are small tiles if there are many samples.
constexpr int kSamplesOfLargeTiles = 64;

int tile_px(const Tracer& tracer, const RenderSettings& settings) {
  const bool small = (settings.outline || settings.fog) && settings.samples_per_pixel > kSamplesOfLargeTiles;
  return tracer.engine() == Engine::wide && !small ? kTilePx : kScalarTilePx;
}

constexpr DistanceRange kNoRange{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

// The state of an unfinished picture.
class Renderer {
 public:
  Renderer(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, const ProgressCallback& progress,
           const CancelToken* cancel, Film film, Transparency transparency)
      : scene_(scene),
        tracer_(tracer),
        settings_(settings),
        progress_(progress),
        cancel_(cancel),
        film_(std::move(film)),
        rays_(scene.camera, settings.width_px, settings.height_px),
        transparency_(std::move(transparency)),
        wave_scene_(scene, settings.opacity_rule),
        effects_(scene, wave_scene_, tracer, settings, rays_, &transparency_),
        drawn_(pixels_to_draw(settings)),
        tiles_(tiles_of(drawn_, tile_px(tracer, settings))),
        counts_(tiles_.size()),
        ranges_(tiles_.size(), kNoRange),
        passes_(settings.view == View::distance ? 2 : 1) {
    if (settings_.shadows && has_soft_light(scene))
      light_points_.emplace(settings_.light_points, settings_.samples_per_pixel);
    if (settings_.ambient_occlusion) ambient_.emplace(*settings_.ambient_occlusion, settings_.samples_per_pixel);
    for (int i = 0; i < settings_.samples_per_pixel; ++i)
      places_.push_back(sample_place(i, settings_.samples_per_pixel));
    film_.resize(drawn_.width(), drawn_.height(), settings_.transparent);
  }

  // The tiles of all passes have consecutive numbers. Runs the tiles from `first` to before `end`, all in one pass.
  void run(std::size_t first, std::size_t end) {
    const std::size_t pass = first / tiles_.size();
    const std::size_t offset = first - pass * tiles_.size();
    // The distance view first needs the range of distances.
    const bool finds_range = pass + 1 < passes_;
    if (passes_ == 2 && pass == 1 && offset == 0) join_ranges();
    parallel_for(settings_.threads, static_cast<std::int64_t>(end - first), [&](std::int64_t i) {
      if (cancelled()) return;
      const std::size_t tile = offset + static_cast<std::size_t>(i);
      if (finds_range)
        find_distance_range(tile);
      else
        render_tile(tiles_[tile], counts_[tile]);
      report_progress();
    });
  }

  std::size_t tiles_in_a_pass() const { return tiles_.size(); }
  std::size_t tiles_in_all() const { return passes_ * tiles_.size(); }
  bool cancelled() const { return cancel_ != nullptr && cancel_->cancelled(); }

  /// Called after the last tile.
  Rendered take() {
    Rendered rendered;
    const bool is_whole =
        drawn_.width() == drawn_pixels(settings_).width() && drawn_.height() == drawn_pixels(settings_).height();
    rendered.film = is_whole ? std::move(film_) : part_of(film_, *settings_.crop);
    for (const RenderCounts& tile : counts_) {
      rendered.rays.primary += tile.primary;
      rendered.rays.shadow += tile.shadow;
      rendered.rays.reflected += tile.reflected;
      rendered.rays.transmitted += tile.transmitted;
      rendered.rays.ambient += tile.ambient;
    }
    return rendered;
  }

 private:
  // The range of distances is that of the whole picture.
  static Tile pixels_to_draw(const RenderSettings& settings) {
    const Tile whole{0, 0, settings.width_px, settings.height_px};
    return settings.view == View::distance ? whole : drawn_pixels(settings);
  }

  PixelPlace film_corner() const {
    return {static_cast<std::uint16_t>(drawn_.x0), static_cast<std::uint16_t>(drawn_.y0)};
  }

  void report_progress() {
    const std::int64_t done = tiles_done_.fetch_add(1) + 1;
    if (!progress_) return;
    // A thread goes on with its work if another thread is reporting.
    const std::unique_lock<std::mutex> lock(progress_mutex_, std::try_to_lock);
    if (lock.owns_lock()) progress_(static_cast<double>(done) / static_cast<double>(passes_ * tiles_.size()));
  }

  // Calls use(pixels, samples, buffers, first) for parts of a tile. The samples first to first + primaries - 1 have
  // primary rays; sample i belongs to pixel i / samples.
  template <class Use>
  void for_each_part(const Tile& tile, const Use& use) const {
    // Each thread has its own, and keeps it from tile to tile and from picture to picture.
    static thread_local WaveBuffers buffers;
    static thread_local std::vector<PixelPlace> pixels;
    order_pixels(tile, pixels);
    const std::int64_t all = std::int64_t{tile.x1 - tile.x0} * (tile.y1 - tile.y0) * settings_.samples_per_pixel;
    for (std::int64_t first = 0; first < all && !cancelled(); first += kMostRaysAtOnce) {
      make_primaries(pixels, first, std::min(kMostRaysAtOnce, all - first), buffers);
      use(pixels, buffers, first);
    }
  }

  void make_primaries(const std::vector<PixelPlace>& pixels, std::int64_t first, std::int64_t count,
                      WaveBuffers& buffers) const {
    Wave& wave = WaveIntegrator::primaries(buffers);
    wave.reset(count);
    wave.count = count;
    wave.starts_at_eye = true;
    const std::int64_t samples = settings_.samples_per_pixel;
    const PixelPlace* pixel = pixels.data() + first / samples;
    if (samples == 1) return steps::camera_rays(rays_, pixel, places_[0], wave);
    buffers.x.reserve(count);
    buffers.y.reserve(count);
    auto sample = static_cast<std::size_t>(first % samples);
    for (std::int64_t i = 0; i < count; ++i) {
      buffers.x[i] = pixel->x + places_[sample].x;
      buffers.y[i] = pixel->y + places_[sample].y;
      if (++sample < places_.size()) continue;
      sample = 0;
      ++pixel;
    }
    steps::camera_rays(rays_, buffers.x.data(), buffers.y.data(), wave);
  }

  void find_distance_range(std::size_t tile) {
    for_each_part(tiles_[tile], [&](const auto&, WaveBuffers& buffers, std::int64_t) {
      WaveIntegrator integrator(wave_scene_, tracer_, {1, false, false, false}, cancel_);
      integrator.find_first_hits(buffers);
      const RaySpan rays = WaveIntegrator::primaries(buffers).span();
      for (std::int64_t i = 0; i < rays.count; ++i) {
        const SceneHit hit{buffers.t[i], buffers.id[i]};
        if (!hit.found()) continue;
        const double distance = distance_of(rays.at(i), hit);
        ranges_[tile].nearest = std::min(ranges_[tile].nearest, distance);
        ranges_[tile].farthest = std::max(ranges_[tile].farthest, distance);
      }
    });
  }

  void join_ranges() {
    range_ = kNoRange;
    for (const DistanceRange& tile : ranges_) {
      range_.nearest = std::min(range_.nearest, tile.nearest);
      range_.farthest = std::max(range_.farthest, tile.farthest);
    }
  }

  void render_tile(const Tile& tile, RenderCounts& counts) {
    const bool shaded = settings_.view == View::shaded;
    WaveIntegrator integrator(
        wave_scene_, tracer_,
        {settings_.recursion, shaded, shaded && settings_.shadows,
         settings_.view == View::recursion || settings_.transparent, ambient_ ? &*ambient_ : nullptr,
         light_points_ ? &*light_points_ : nullptr, settings_.samples_per_pixel, &transparency_},
        cancel_);
    // Each thread has its own.
    static thread_local EffectBuffers effects;
    if (effects_.any()) effects_.find(tile, places_, cancel_, effects);
    const std::int64_t samples = settings_.samples_per_pixel;
    PixelSum sum;
    for_each_part(tile, [&](const std::vector<PixelPlace>& pixels, WaveBuffers& buffers, std::int64_t first) {
      const std::int64_t count = WaveIntegrator::primaries(buffers).count;
      if (shaded || settings_.view == View::recursion)
        integrator.trace(buffers, count, first % samples);
      else if (settings_.view != View::traversal)
        integrator.find_first_hits(buffers);
      if (cancelled()) return;

      if (shaded && samples == 1 && !settings_.transparent && !effects_.any())
        return steps::put_light(buffers.sums, pixels.data() + first, count, film_corner(), film_);

      // Add the samples in order, then divide by their number.
      for (std::int64_t i = 0; i < count; ++i) {
        const PixelPlace& pixel = pixels[static_cast<std::size_t>((first + i) / samples)];
        if (!settings_.transparent || hits_something(buffers, integrator, i)) {
          Vec3d value = sample_value(buffers, integrator, i);
          if (effects_.any()) value = effects_.applied(tile, effects, pixel.x, pixel.y, sum.samples, value);
          sum.light = sum.light + value;
          sum.covered += settings_.transparent ? integrator.coverage(i) : 1;
        }
        if (++sum.samples < samples) continue;
        put(sum, pixel);
        sum = {};
      }
    });
    counts = integrator.rays();
    counts.primary = std::int64_t{tile.x1 - tile.x0} * (tile.y1 - tile.y0) * samples;
  }

  // The samples of one pixel so far; `covered`: those that add to its light, partly where the background shines
  // through.
  struct PixelSum {
    Vec3d light;
    double covered = 0;
    std::int64_t samples = 0;
  };

  void put(const PixelSum& sum, PixelPlace pixel) {
    const std::size_t number = film_.number_of(pixel.x - drawn_.x0, pixel.y - drawn_.y0);
    const Vec3d light = sum.covered > 0 ? sum.light / sum.covered : Vec3d{};
    film_.radiance[number] = to_float(light);
    if (settings_.transparent)
      film_.coverage[number] = static_cast<float>(sum.covered / static_cast<double>(sum.samples));
  }

  bool hits_something(const WaveBuffers& buffers, const WaveIntegrator& integrator, std::int64_t i) const {
    const bool traced = settings_.view == View::shaded || settings_.view == View::recursion;
    return traced ? integrator.deepest_hit()[static_cast<std::size_t>(i)] > 0 : buffers.id[i] != kNothing;
  }

  Vec3d sample_value(WaveBuffers& buffers, const WaveIntegrator& integrator, std::int64_t i) const {
    const auto ray = [&] { return WaveIntegrator::primaries(buffers).span().at(i); };
    const auto hit = [&] { return SceneHit{buffers.t[i], buffers.id[i]}; };
    switch (settings_.view) {
      case View::shaded:
        return buffers.sums.at(i);
      case View::recursion:
        return recursion_colour(integrator.deepest_hit()[static_cast<std::size_t>(i)]);
      case View::traversal:
        return traversal_colour(tracer_, ray());
      case View::normal:
        return normal_colour(scene_, ray(), hit());
      case View::distance:
        return distance_colour(ray(), hit(), range_);
      case View::id:
      case View::tree:  // has no samples
        break;
    }
    return id_colour(input_id(scene_, buffers.id[i]));
  }

  const Scene& scene_;
  const Tracer& tracer_;
  RenderSettings settings_;
  ProgressCallback progress_;
  const CancelToken* cancel_;
  Film film_;
  PixelRays rays_;
  Transparency transparency_;
  WaveScene wave_scene_;
  AfterEffects effects_;
  Tile drawn_;                       // the film's pixels in the whole picture
  std::vector<SamplePlace> places_;  // in a pixel
  std::optional<AmbientRays> ambient_;
  std::optional<LightPointSets> light_points_;
  std::vector<Tile> tiles_;
  std::vector<RenderCounts> counts_;  // of each tile
  std::vector<DistanceRange> ranges_;
  DistanceRange range_{0, 0};
  std::size_t passes_;
  std::atomic<std::int64_t> tiles_done_{0};
  std::mutex progress_mutex_;
};

// The pictures that follow light need it.
Result<Transparency> transparency_of(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  if (settings.view != View::shaded && settings.view != View::recursion) return Transparency();
  return Transparency::of(scene, settings.opacity_rule, tracer.engine(), settings.threads);
}

Status check_settings(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  BIHIVE_CHECK(settings.width_px >= 1 && settings.width_px <= 65535);
  BIHIVE_CHECK(settings.height_px >= 1 && settings.height_px <= 65535);
  BIHIVE_CHECK(settings.samples_per_pixel >= 1 && settings.samples_per_pixel <= 4096);
  BIHIVE_CHECK(settings.recursion >= 1 && settings.recursion <= 16);
  BIHIVE_CHECK_GE(settings.threads, 0);
  if (settings.ambient_occlusion) {
    BIHIVE_CHECK(settings.ambient_occlusion->distance > 0);
    BIHIVE_CHECK(settings.ambient_occlusion->directions >= 1 &&
                 settings.ambient_occlusion->directions <= kMostAmbientDirections);
  }
  BIHIVE_CHECK(settings.light_points >= 1 && settings.light_points <= kMostLightPoints);
  if (settings.outline) {
    BIHIVE_CHECK(settings.outline->width_px >= 1 && settings.outline->width_px <= kWidestOutlinePx);
    BIHIVE_CHECK(settings.outline->step >= 0);
  }
  if (settings.fog) BIHIVE_CHECK(settings.fog->start < settings.fog->end);
  const Tile drawn = drawn_pixels(settings);
  BIHIVE_CHECK(drawn.x0 >= 0 && drawn.x0 < drawn.x1 && drawn.x1 <= settings.width_px);
  BIHIVE_CHECK(drawn.y0 >= 0 && drawn.y0 < drawn.y1 && drawn.y1 <= settings.height_px);
  if (Status status = check_camera(scene.camera); !status) return status.error();
  const bool of_tree = settings.view == View::traversal || settings.view == View::tree;
  if (of_tree && tracer.tree() == nullptr)
    return Error{"this view shows the reference tree, which the engine does not have", "", 0, 0,
                 "choose the reference engine"};
  if (of_tree && settings.transparent)
    return Error{"this view of the tree has no transparent background", "", 0, 0, "choose another view"};
  return Done{};
}

}  // namespace

Result<Rendered> render(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                        const ProgressCallback& progress, const CancelToken* cancel, Film film) {
  if (Status status = check_settings(scene, tracer, settings); !status) return status.error();
  if (settings.view == View::tree) return render_tree_picture(scene, tracer, settings, progress, cancel);
  const Timer timer;
  Result<Transparency> transparency = transparency_of(scene, tracer, settings);
  if (!transparency) return transparency.error();
  Renderer renderer(scene, tracer, settings, progress, cancel, std::move(film), std::move(*transparency));
  for (std::size_t first = 0; first < renderer.tiles_in_all(); first += renderer.tiles_in_a_pass())
    renderer.run(first, first + renderer.tiles_in_a_pass());
  if (renderer.cancelled()) return Error{"cancelled", "", 0, 0, ""};
  Rendered rendered = renderer.take();
  rendered.render_ms = timer.elapsed_ms();
  return rendered;
}

class SlicedPicture::Implementation {
 public:
  Implementation(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, Film film,
                 Transparency transparency)
      : scene_(scene), tracer_(tracer), settings_(settings) {
    if (settings.view != View::tree)
      renderer_.emplace(scene, tracer, settings, nullptr, nullptr, std::move(film), std::move(transparency));
    slice_ = least_slice_ = static_cast<std::size_t>(settings.threads == 0 ? hardware_threads() : settings.threads);
  }

  void advance(double budget_ms) {
    const Timer timer;
    if (!renderer_ && !rendered_) {
      Result<Rendered> rendered = render_tree_picture(scene_, tracer_, settings_);
      BIHIVE_CHECK(rendered.ok());  // only a cancel could end it
      rendered_ = std::move(*rendered);
    }
    while (!finished()) {
      // Draw some tiles of one pass; more at a time if they take very little time.
      const Timer of_slice;
      const std::size_t pass_end = (done_ / renderer_->tiles_in_a_pass() + 1) * renderer_->tiles_in_a_pass();
      const std::size_t end = std::min(done_ + slice_, pass_end);
      renderer_->run(done_, end);
      done_ = end;
      if (of_slice.elapsed_ms() < budget_ms / 16) slice_ *= 2;
      if (of_slice.elapsed_ms() > budget_ms / 4) slice_ = std::max(slice_ / 2, least_slice_);
      if (timer.elapsed_ms() >= budget_ms) break;
    }
    spent_ms_ += timer.elapsed_ms();
  }

  bool finished() const { return renderer_ ? done_ == renderer_->tiles_in_all() : rendered_.has_value(); }

  double done() const {
    if (!renderer_) return rendered_ ? 1 : 0;
    return static_cast<double>(done_) / static_cast<double>(renderer_->tiles_in_all());
  }

  Rendered take() {
    BIHIVE_CHECK(finished());
    Rendered rendered = renderer_ ? renderer_->take() : std::move(*rendered_);
    rendered.render_ms = spent_ms_;
    return rendered;
  }

 private:
  const Scene& scene_;
  const Tracer& tracer_;
  RenderSettings settings_;
  std::optional<Renderer> renderer_;  // none: the tree's picture
  std::optional<Rendered> rendered_;
  std::size_t done_ = 0;             // tiles
  std::size_t slice_, least_slice_;  // tiles at a time
  double spent_ms_ = 0;
};

Result<SlicedPicture> SlicedPicture::begin(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                           Film film) {
  if (Status status = check_settings(scene, tracer, settings); !status) return status.error();
  Result<Transparency> transparency = transparency_of(scene, tracer, settings);
  if (!transparency) return transparency.error();
  return SlicedPicture(
      std::make_unique<Implementation>(scene, tracer, settings, std::move(film), std::move(*transparency)));
}

SlicedPicture::SlicedPicture(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
SlicedPicture::SlicedPicture(SlicedPicture&& other) noexcept = default;
SlicedPicture& SlicedPicture::operator=(SlicedPicture&& other) noexcept = default;
SlicedPicture::~SlicedPicture() = default;

void SlicedPicture::advance(double budget_ms) {
  implementation_->advance(budget_ms);
}
bool SlicedPicture::finished() const {
  return implementation_->finished();
}
double SlicedPicture::done() const {
  return implementation_->done();
}
Rendered SlicedPicture::take() {
  return implementation_->take();
}

}  // namespace bihive
