#include "bihive/render/renderer.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/render/integrator.h"
#include "bihive/render/sample_pattern.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tree_picture.h"
#include "bihive/render/views.h"

namespace bihive {
namespace {

constexpr int kTilePx = 16;

// The state of one picture in the making.
class Renderer {
 public:
  Renderer(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, const ProgressCallback& progress,
           const CancelToken* cancel)
      : scene_(scene),
        tracer_(tracer),
        settings_(settings),
        progress_(progress),
        cancel_(cancel),
        rays_(scene.camera, settings.width_px, settings.height_px),
        tiles_(tiles_of(settings.width_px, settings.height_px, kTilePx)) {}

  Result<Rendered> run() {
    const Timer timer;
    Rendered rendered;
    rendered.film = Film(settings_.width_px, settings_.height_px);
    passes_ = settings_.view == View::distance ? 2 : 1;

    // The distance view needs the range of distances first.
    if (settings_.view == View::distance) range_ = find_distance_range();

    // Each tile writes its own pixels and its own counts.
    std::vector<RenderCounts> counts(tiles_.size());
    for_each_tile([&](std::size_t i) { render_tile(tiles_[i], rendered.film, counts[i]); });
    if (cancelled()) return Error{"cancelled", "", 0, 0, ""};
    for (const RenderCounts& tile : counts) {
      rendered.rays.primary += tile.primary;
      rendered.rays.shadow += tile.shadow;
      rendered.rays.reflected += tile.reflected;
      rendered.rays.transmitted += tile.transmitted;
    }
    rendered.render_ms = timer.elapsed_ms();
    return rendered;
  }

 private:
  bool cancelled() const { return cancel_ != nullptr && cancel_->cancelled(); }

  template <class Body>
  void for_each_tile(const Body& body) {
    parallel_for(settings_.threads, static_cast<std::int64_t>(tiles_.size()), [&](std::int64_t i) {
      if (cancelled()) return;
      body(static_cast<std::size_t>(i));
      report_progress();
    });
  }

  void report_progress() {
    const std::int64_t done = tiles_done_.fetch_add(1) + 1;
    if (!progress_) return;
    // Whoever finds another thread reporting goes on with its work.
    const std::unique_lock<std::mutex> lock(progress_mutex_, std::try_to_lock);
    if (lock.owns_lock()) progress_(static_cast<double>(done) / static_cast<double>(passes_ * tiles_.size()));
  }

  template <class Body>
  void for_each_sample(const Tile& tile, const Body& body) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        for (int i = 0; i < settings_.samples_per_pixel; ++i) {
          const SamplePlace place = sample_place(i, settings_.samples_per_pixel);
          body(rays_.at(x + place.x, y + place.y));
        }
  }

  DistanceRange find_distance_range() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::vector<DistanceRange> ranges(tiles_.size(), {inf, -inf});
    for_each_tile([&](std::size_t i) {
      for_each_sample(tiles_[i], [&](const Ray& ray) {
        const SceneHit hit = scene_hit(scene_, tracer_, ray);
        if (!hit.found()) return;
        const double distance = distance_of(ray, hit);
        ranges[i].nearest = std::min(ranges[i].nearest, distance);
        ranges[i].farthest = std::max(ranges[i].farthest, distance);
      });
    });
    DistanceRange range{inf, -inf};
    for (const DistanceRange& tile : ranges) {
      range.nearest = std::min(range.nearest, tile.nearest);
      range.farthest = std::max(range.farthest, tile.farthest);
    }
    return range;
  }

  void render_tile(const Tile& tile, Film& film, RenderCounts& counts) const {
    Integrator integrator(scene_, tracer_, settings_.recursion, settings_.view == View::shaded && settings_.shadows);
    std::int64_t primary = 0;
    const int samples = settings_.samples_per_pixel;
    for (int y = tile.y0; y < tile.y1; ++y) {
      if (cancelled()) return;
      for (int x = tile.x0; x < tile.x1; ++x) {
        // Add the samples in order, then divide by their number.
        Vec3d sum;
        for (int i = 0; i < samples; ++i) {
          const SamplePlace place = sample_place(i, samples);
          sum = sum + sample_value(rays_.at(x + place.x, y + place.y), integrator);
          ++primary;
        }
        film.at(x, y) = to_float(sum / samples);
      }
    }
    counts = integrator.rays();
    counts.primary = primary;
  }

  Vec3d sample_value(const Ray& ray, Integrator& integrator) const {
    switch (settings_.view) {
      case View::shaded:
        return integrator.radiance(ray);
      case View::recursion:
        integrator.radiance(ray);
        return recursion_colour(integrator.deepest_hit());
      case View::traversal:
        return traversal_colour(tracer_, ray);
      case View::normal:
        return normal_colour(scene_, ray, scene_hit(scene_, tracer_, ray));
      case View::distance:
        return distance_colour(ray, scene_hit(scene_, tracer_, ray), range_);
      case View::id:
      case View::tree:  // is not made of samples
        break;
    }
    return id_colour(scene_hit(scene_, tracer_, ray).id);
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const RenderSettings& settings_;
  const ProgressCallback& progress_;
  const CancelToken* cancel_;
  PixelRays rays_;
  std::vector<Tile> tiles_;
  DistanceRange range_{0, 0};
  std::size_t passes_ = 1;
  std::atomic<std::int64_t> tiles_done_{0};
  std::mutex progress_mutex_;
};

}  // namespace

RenderSettings settings_from(const PictureDefaults& defaults) {
  RenderSettings settings;
  settings.width_px = defaults.width_px;
  settings.height_px = defaults.height_px;
  settings.samples_per_pixel = defaults.samples_per_pixel;
  settings.recursion = defaults.recursion;
  settings.shadows = defaults.shadows;
  return settings;
}

Result<Rendered> render(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                        const ProgressCallback& progress, const CancelToken* cancel) {
  BIHIVE_CHECK(settings.width_px >= 1 && settings.width_px <= 65535);
  BIHIVE_CHECK(settings.height_px >= 1 && settings.height_px <= 65535);
  BIHIVE_CHECK(settings.samples_per_pixel >= 1 && settings.samples_per_pixel <= 4096);
  BIHIVE_CHECK(settings.recursion >= 1 && settings.recursion <= 16);
  BIHIVE_CHECK_GE(settings.threads, 0);
  if (Status status = check_camera(scene.camera); !status) return status.error();
  const bool of_tree = settings.view == View::traversal || settings.view == View::tree;
  if (of_tree && tracer.tree() == nullptr)
    return Error{"this view shows the reference tree, which the engine does not have", "", 0, 0,
                 "choose the reference engine"};
  if (settings.view == View::tree) return render_tree_picture(scene, tracer, settings, progress, cancel);
  return Renderer(scene, tracer, settings, progress, cancel).run();
}

Image image_from_film(const Film& film, View view, Transfer transfer) {
  const Transfer curve = view == View::shaded ? transfer : Transfer::none;
  Image image{film.width, film.height, {}};
  image.rgb.reserve(3 * film.radiance.size());
  for (const Vec3f& pixel : film.radiance)
    for (int channel = 0; channel < 3; ++channel)
      image.rgb.push_back(byte_from_radiance(double(pixel[channel]), curve));
  return image;
}

}  // namespace bihive
