#include "bihive/render/picture/drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/base/setting_name.h"
#include "bihive/render/memory.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tree_picture.h"
#include "bihive/scene/clips.h"

namespace bihive {
namespace {

// Tiles of the wide engine are large enough for its vectors and small enough for the cache. The other engines need
// neither.
constexpr int kTilePx = 64;
constexpr int kScalarTilePx = 16;

// Outlines and fog keep something for each sample of a tile, so there are small tiles if there are many samples.
constexpr int kSamplesOfLargeTiles = 64;

// First samples of every pixel.
int first_samples(const RenderSettings& settings) {
  return settings.adaptive_samples ? kFewSamples : settings.samples_per_pixel;
}

bool is_adaptive(const RenderSettings& settings) {
  return settings.adaptive_samples && settings.view == View::shaded;
}

int tile_px(const Tracer& tracer, const RenderSettings& settings) {
  const bool small = (settings.outline || settings.fog) && first_samples(settings) > kSamplesOfLargeTiles;
  return tracer.engine() == Engine::wide && !small ? kTilePx : kScalarTilePx;
}

constexpr DistanceRange kNoRange{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

double bytes_of(const Film& film) {
  return static_cast<double>(film.radiance.capacity() * sizeof(film.radiance[0]) +
                             film.coverage.capacity() * sizeof(film.coverage[0]));
}

// The range of distances is that of the whole picture. Adaptive samples look at the pixels around each pixel.
Tile pixels_to_draw(const RenderSettings& settings) {
  const Tile whole{0, 0, settings.width_px, settings.height_px};
  if (settings.view == View::distance) return whole;
  const Tile part = drawn_pixels(settings);
  const int border = is_adaptive(settings) ? 1 : 0;
  return {std::max(part.x0 - border, 0), std::max(part.y0 - border, 0), std::min(part.x1 + border, whole.x1),
          std::min(part.y1 + border, whole.y1)};
}

std::int64_t pixels_in(const Tile& tile) {
  return std::int64_t{tile.width()} * tile.height();
}

// The pixels of a tile in the order of their rays. Each thread has its own list, and keeps it from tile to tile and
// from picture to picture.
std::vector<PixelPlace>& pixels_of(const Tile& tile) {
  static thread_local std::vector<PixelPlace> pixels;
  order_pixels(tile, pixels);
  return pixels;
}

// The pictures that follow light need it.
Result<Transparency> transparency_of(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  if (settings.view != View::shaded && settings.view != View::recursion) return Transparency();
  return Transparency::of(scene, settings.opacity_rule, tracer, settings.threads);
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
  BIHIVE_CHECK(settings.light_sets == 1 || settings.light_sets == kSharedSets);
  BIHIVE_CHECK(settings.line_scale >= 0);
  if (settings.outline) {
    BIHIVE_CHECK(settings.outline->width_px >= 1 && settings.outline->width_px <= kWidestOutlinePx);
    BIHIVE_CHECK(settings.outline->step >= 0);
  }
  BIHIVE_CHECK(std::abs(settings.tone.exposure_stops) <= kMostExposureStops);
  if (settings.fog) BIHIVE_CHECK(settings.fog->start < settings.fog->end);
  const Tile drawn = drawn_pixels(settings);
  BIHIVE_CHECK(drawn.x0 >= 0 && drawn.x0 < drawn.x1 && drawn.x1 <= settings.width_px);
  BIHIVE_CHECK(drawn.y0 >= 0 && drawn.y0 < drawn.y1 && drawn.y1 <= settings.height_px);
  if (Status status = check_camera(settings.camera.value_or(scene.camera)); !status) return status.error();
  const bool of_tree = settings.view == View::traversal || settings.view == View::tree;
  if (of_tree && scene.spheres.has_images())
    return Error{"this view shows the tree of the stored spheres, and the set has copies", "", 0, 0,
                 "leave out " + setting_name("replicate")};
  if (scene.spheres.has_images() != tracer.has_images())
    return Error{"the tracer does not have the copies of the scene", "", 0, 0, "build the tracer from the scene"};
  const bool is_cut = cut_set_of(scene) != nullptr;
  if (of_tree && is_cut)
    return Error{"this view shows the tree of whole spheres, and clips cut the spheres", "", 0, 0,
                 "leave out the clips"};
  if (is_cut != tracer.has_clips())
    return Error{"the tracer does not have the clips of the scene", "", 0, 0, "build the tracer from the scene"};
  if (Status status = check_sticks(scene); !status) return status.error();
  if (of_tree && !scene.sticks.empty())
    return Error{"this view shows the tree of the spheres, and there are sticks", "", 0, 0, "leave out the sticks"};
  if (tracer.has_sticks() == scene.sticks.empty())
    return Error{"the tracer does not have the sticks of the scene", "", 0, 0, "build the tracer from the scene"};
  if (of_tree && scene.cavity_walls != nullptr)
    return Error{"this view shows the tree of whole spheres, and the picture is of cavities", "", 0, 0,
                 "leave out " + setting_name("show_cavities")};
  if (tracer.has_cavities() != (scene.cavity_walls != nullptr))
    return Error{"the tracer does not have the cavities of the scene", "", 0, 0, "build the tracer from the scene"};
  if (of_tree && tracer.tree() == nullptr)
    return Error{"this view shows the reference tree, which the engine does not have", "", 0, 0,
                 "choose the reference engine"};
  if (of_tree && settings.transparent)
    return Error{"this view of the tree has no transparent background", "", 0, 0, "choose another view"};
  return Done{};
}

}  // namespace

Drawing::SampleSet::SampleSet(const Scene& scene, const RenderSettings& settings, int count, bool shares_light)
    : places(camera_samples(count)), light_sets(shares_light && count == 1 ? settings.light_sets : 1) {
  const int sets = count * light_sets;
  if (settings.shadows && has_soft_light(scene)) light_points.emplace(settings.light_points, sets);
  if (settings.ambient_occlusion) ambient.emplace(*settings.ambient_occlusion, sets);
}

Result<std::unique_ptr<Drawing>> Drawing::begin(const Scene& scene, const Tracer& tracer,
                                                const RenderSettings& settings, const ProgressCallback& progress,
                                                const CancelToken* cancel) {
  if (Status status = check_settings(scene, tracer, settings); !status) return status.error();
  Result<Transparency> transparency = transparency_of(scene, tracer, settings);
  if (!transparency) return transparency.error();
  return std::unique_ptr<Drawing>(new Drawing(scene, tracer, settings, progress, cancel, std::move(*transparency)));
}

Drawing::Drawing(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                 const ProgressCallback& progress, const CancelToken* cancel, Transparency transparency)
    : scene_(scene),
      tracer_(tracer),
      settings_(settings),
      progress_(progress),
      cancel_(cancel),
      rays_(picture_camera(scene, settings), settings.width_px, settings.height_px),
      transparency_(std::move(transparency)),
      wave_scene_(scene, transparency_.to_eye ? OpacityRule::once : OpacityRule::each_surface),
      post_processing_(scene, wave_scene_, tracer, settings, rays_, &transparency_),
      passes_(settings.view == View::distance || is_adaptive(settings) ? 2 : 1),
      first_set_(scene, settings, first_samples(settings), transparency_.to_eye == nullptr) {
  if (is_adaptive(settings)) second_set_.emplace(scene, settings, kManySamples, false);
}

Status Drawing::start(const Tile& part, Film film) {
  settings_.crop = part;
  drawn_ = pixels_to_draw(settings_);
  if (film_.radiance.empty()) film_ = std::move(film);
  if (tiles_.empty())  // the first part
    if (Status status = check_film_memory(settings_, bytes_of(film_)); !status) return status;
  tiles_ = settings_.view == View::tree ? std::vector<Tile>{drawn_} : tiles_of(drawn_, tile_px(tracer_, settings_));
  counts_.assign(tiles_.size(), {});
  ranges_.assign(tiles_.size(), kNoRange);
  tiles_done_ = 0;
  if (second_set_) edges_.resize(drawn_.width(), drawn_.height());
  if (settings_.view != View::tree) film_.resize(drawn_.width(), drawn_.height(), settings_.transparent);
  return Done{};
}

void Drawing::run(std::size_t first, std::size_t end) {
  if (settings_.view == View::tree) return draw_tree();
  begin_pass(first);
  parallel_for(settings_.threads, static_cast<std::int64_t>(end - first),
               [&](std::int64_t i) { run_tile(first + static_cast<std::size_t>(i)); });
}

// The distance view first needs the range of distances, and adaptive samples need a first picture.
void Drawing::begin_pass(std::size_t first) {
  if (first == tiles_.size() && settings_.view != View::tree) begin_second_pass();
}

void Drawing::run_tile(std::size_t tile) {
  if (settings_.view == View::tree) return draw_tree();
  if (cancelled()) return;
  const std::size_t pass = tile / tiles_.size();
  const std::size_t place = tile - pass * tiles_.size();
  if (settings_.view == View::distance && pass == 0)
    find_distance_range(place);
  else if (pass == 1 && second_set_)
    refine_tile(tiles_[place], counts_[place]);
  else
    draw_pixels(tiles_[place], pixels_of(tiles_[place]), pixels_in(tiles_[place]), first_set_, counts_[place]);
  report_progress();
}

void Drawing::run_all() {
  for (std::size_t first = 0; first < tiles_in_all(); first += tiles_in_a_pass()) run(first, first + tiles_in_a_pass());
}

Result<Rendered> Drawing::take() {
  if (failure_) return *failure_;
  if (cancelled()) return cancelled_error();
  Rendered rendered;
  const Tile& part = *settings_.crop;
  const bool is_whole = drawn_.width() == part.width() && drawn_.height() == part.height();
  rendered.film =
      is_whole ? std::move(film_)
               : part_of(film_, {part.x0 - drawn_.x0, part.y0 - drawn_.y0, part.x1 - drawn_.x0, part.y1 - drawn_.y0});
  for (const RenderCounts& tile : counts_) rendered.rays += tile;
  return rendered;
}

void Drawing::draw_tree() {
  Result<Rendered> tree = render_tree_picture(scene_, tracer_, settings_, progress_, cancel_);
  if (!tree) {
    failure_ = tree.error();
    return;
  }
  film_ = std::move(tree->film);
  counts_[0] = tree->rays;
}

void Drawing::report_progress() {
  const std::int64_t done = tiles_done_.fetch_add(1) + 1;
  if (!progress_) return;
  // A thread goes on with its work if another thread is reporting.
  const std::unique_lock<std::mutex> lock(progress_mutex_, std::try_to_lock);
  if (lock.owns_lock()) progress_(static_cast<double>(done) / static_cast<double>(tiles_in_all()));
}

// Calls use(buffers, first) for waves of the first `pixel_count` pixels. The samples first to first + primaries - 1
// have primary rays; sample i belongs to pixel i / (samples of the set).
template <class Use>
void Drawing::for_each_wave(const std::vector<PixelPlace>& pixels, std::int64_t pixel_count, const SampleSet& set,
                            const Use& use) const {
  // Each thread has its own.
  static thread_local WaveBuffers buffers;
  const std::int64_t all = pixel_count * set.count();
  for (std::int64_t first = 0; first < all && !cancelled(); first += kMostRaysAtOnce) {
    make_primaries(pixels, first, std::min(kMostRaysAtOnce, all - first), set, buffers);
    use(buffers, first);
  }
}

void Drawing::make_primaries(const std::vector<PixelPlace>& pixels, std::int64_t first, std::int64_t count,
                             const SampleSet& set, WaveBuffers& buffers) const {
  Wave& wave = WaveIntegrator::primaries(buffers);
  wave.reset(count);
  wave.count = count;
  wave.starts_at_eye = true;
  const std::int64_t samples = set.count();
  const PixelPlace* pixel = pixels.data() + first / samples;
  if (samples == 1 && !rays_.has_lens()) return steps::camera_rays(rays_, pixel, set.places[0].place, wave);
  buffers.reserve_positions(count);
  auto sample = static_cast<std::size_t>(first % samples);
  const bool has_lens = rays_.has_lens();
  for (std::int64_t i = 0; i < count; ++i) {
    const CameraSample& at = set.places[sample];
    buffers.x[i] = pixel->x + at.place.x;
    buffers.y[i] = pixel->y + at.place.y;
    if (has_lens) {
      buffers.lens_x[i] = at.lens.x;
      buffers.lens_y[i] = at.lens.y;
    }
    if (++sample < set.places.size()) continue;
    sample = 0;
    ++pixel;
  }
  steps::camera_rays(rays_, buffers.positions(), wave);
}

void Drawing::find_distance_range(std::size_t tile) {
  for_each_wave(pixels_of(tiles_[tile]), pixels_in(tiles_[tile]), first_set_, [&](WaveBuffers& buffers, std::int64_t) {
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

void Drawing::begin_second_pass() {
  if (second_set_) return edges_.find(film_, settings_.threads);
  range_ = kNoRange;
  for (const DistanceRange& tile : ranges_) {
    range_.nearest = std::min(range_.nearest, tile.nearest);
    range_.farthest = std::max(range_.farthest, tile.farthest);
  }
}

// Draws the pixels on edges once more, with more samples.
void Drawing::refine_tile(const Tile& tile, RenderCounts& counts) {
  const Tile wanted = drawn_pixels(settings_);
  const Tile inside{std::max(tile.x0, wanted.x0), std::max(tile.y0, wanted.y0), std::min(tile.x1, wanted.x1),
                    std::min(tile.y1, wanted.y1)};
  if (inside.width() <= 0 || inside.height() <= 0) return;
  std::vector<PixelPlace>& pixels = pixels_of(inside);
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < pixels_in(inside); ++i) {
    const PixelPlace pixel = pixels[static_cast<std::size_t>(i)];
    if (edges_.at(pixel.x - drawn_.x0, pixel.y - drawn_.y0)) pixels[static_cast<std::size_t>(count++)] = pixel;
  }
  if (count > 0) draw_pixels(inside, pixels, count, *second_set_, counts);
}

// The samples of one pixel so far; `covered`: those that add to its light, partly where the background shines
// through.
struct Drawing::PixelSum {
  Vec3d light;
  double covered = 0;
  std::int64_t samples = 0;
  SampleRange range;  // known in the first pass of adaptive samples

  bool differs() const { return range.differs() || (covered != 0 && covered != static_cast<double>(samples)); }
};

// Draws the first `pixel_count` pixels of a list, which lie in the tile, and adds their rays to `counts`.
void Drawing::draw_pixels(const Tile& tile, const std::vector<PixelPlace>& pixels, std::int64_t pixel_count,
                          const SampleSet& set, RenderCounts& counts) {
  const bool shaded = settings_.view == View::shaded;
  const bool toned = shaded && settings_.tone.any();
  WaveIntegrator integrator(wave_scene_, tracer_,
                            {settings_.recursion, shaded, shaded && settings_.shadows,
                             settings_.view == View::recursion || settings_.transparent || toned,
                             set.ambient ? &*set.ambient : nullptr, set.light_points ? &*set.light_points : nullptr,
                             set.count() * set.light_sets, &transparency_, settings_.transparent, set.light_sets > 1},
                            cancel_);
  static thread_local EffectBuffers effects;
  if (post_processing_.any()) post_processing_.find(tile, set.places, cancel_, effects);
  const std::int64_t samples = set.count();
  const bool notes_edges = second_set_ && &set == &first_set_;
  PixelSum sum;
  for_each_wave(pixels, pixel_count, set, [&](WaveBuffers& buffers, std::int64_t first) {
    const std::int64_t count = WaveIntegrator::primaries(buffers).count;
    if (shaded || settings_.view == View::recursion)
      integrator.trace(buffers, count, first % samples, pixels.data() + first / samples);
    else if (settings_.view != View::traversal)
      integrator.find_first_hits(buffers);
    if (cancelled()) return;

    if (toned) steps::tone_light(settings_.tone, integrator.deepest_hit().data(), count, buffers.sums);
    if (shaded && samples == 1 && !settings_.transparent && !post_processing_.any())
      return steps::put_light(buffers.sums, pixels.data() + first, count,
                              {static_cast<std::uint16_t>(drawn_.x0), static_cast<std::uint16_t>(drawn_.y0)}, film_);

    // Add the samples in order, then divide by their number.
    for (std::int64_t i = 0; i < count; ++i) {
      const PixelPlace& pixel = pixels[static_cast<std::size_t>((first + i) / samples)];
      const bool edge =
          post_processing_.any() && post_processing_.is_cell_edge(tile, effects, pixel.x, pixel.y, sum.samples);
      const bool hit =
          !settings_.transparent ||
          (wave_scene_.shadows_only && shaded ? integrator.coverage(i) > 0 : hits_something(buffers, integrator, i));
      if (hit || edge) {
        Vec3d value = hit ? sample_value(buffers, integrator, i) : Vec3d{};
        if (post_processing_.any())
          value = post_processing_.applied(tile, effects, pixel.x, pixel.y, sum.samples, value, integrator.passing(i));
        sum.light = sum.light + value;
        sum.covered += settings_.transparent && !edge ? integrator.coverage(i) : 1;
        if (notes_edges) sum.range.add(value);
      }
      if (++sum.samples < samples) continue;
      put(sum, pixel);
      if (notes_edges) edges_.note(pixel.x - drawn_.x0, pixel.y - drawn_.y0, sum.differs());
      sum = {};
    }
  });
  RenderCounts rays = integrator.rays();
  rays.primary = pixel_count * samples;
  counts += rays;
}

void Drawing::put(const PixelSum& sum, PixelPlace pixel) {
  const std::size_t number = film_.number_of(pixel.x - drawn_.x0, pixel.y - drawn_.y0);
  const Vec3d light = sum.covered > 0 ? sum.light / sum.covered : Vec3d{};
  film_.radiance[number] = to_float(light);
  if (settings_.transparent)
    film_.coverage[number] = static_cast<float>(sum.covered / static_cast<double>(sum.samples));
}

bool Drawing::hits_something(const WaveBuffers& buffers, const WaveIntegrator& integrator, std::int64_t i) const {
  const bool traced = settings_.view == View::shaded || settings_.view == View::recursion;
  return traced ? integrator.deepest_hit()[static_cast<std::size_t>(i)] > 0 : buffers.id[i] != kNothing;
}

Vec3d Drawing::sample_value(WaveBuffers& buffers, const WaveIntegrator& integrator, std::int64_t i) const {
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
      return normal_colour(scene_, ray(), hit(), wave_scene_.cuts.get());
    case View::distance:
      return distance_colour(ray(), hit(), range_);
    case View::id:
    case View::tree:  // has no samples
      break;
  }
  return id_colour(input_id(scene_, buffers.id[i]));
}

}  // namespace bihive
