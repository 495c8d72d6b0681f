#include "bihive/render/renderer.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/render/picture/drawing.h"
#include "bihive/render/stereo.h"

namespace bihive {
namespace {

// Takes a finished part, and may keep its film.
using Sink = std::function<Status(Film& film, const Tile& pixels)>;

// The caller's own callback and token; without both, those of the thread's Watch.
class Observers {
 public:
  Observers(const ProgressCallback& progress, const CancelToken* cancel) : progress_(progress), cancel_(cancel) {
    if (!work_.is_watched() || progress || cancel != nullptr) return;
    progress_ = [this](double done) { work_.report(done); };
    cancel_ = work_.cancel();
  }
  const ProgressCallback& progress() const { return progress_; }
  const CancelToken* cancel() const { return cancel_; }

 private:
  WatchedWork work_;
  ProgressCallback progress_;
  const CancelToken* cancel_;
};

// The one way to draw at once: part after part, each of which goes to the sink.
Result<RenderedBands> draw(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                           const NextPart& next, const Sink& sink, const ProgressCallback& progress,
                           const CancelToken* cancel, Film film = {}) {
  Timer timer;
  const Result<std::unique_ptr<Drawing>> begun = Drawing::begin(scene, tracer, settings, progress, cancel);
  if (!begun) return begun.error();
  Drawing& drawing = **begun;
  RenderedBands rendered;
  for (std::optional<Tile> part = next(); part; part = next()) {
    if (Status status = drawing.start(*part, std::move(film)); !status) return status.error();
    drawing.run_all();
    Result<Rendered> drawn = drawing.take();
    if (!drawn) return drawn.error();
    rendered.rays += drawn->rays;
    rendered.render_ms += timer.elapsed_ms();
    if (Status status = sink(drawn->film, *part); !status) return status.error();
    film = std::move(drawn->film);
    timer = Timer();
  }
  return rendered;
}

}  // namespace

Result<Rendered> render(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                        const ProgressCallback& progress, const CancelToken* cancel, Film film) {
  const Observers observers(progress, cancel);
  if (settings.stereo.form != StereoForm::none)
    return render_stereo(scene, tracer, settings, observers.progress(), observers.cancel());
  Rendered whole;
  std::optional<Tile> rest = drawn_pixels(settings);
  const auto next = [&] { return std::exchange(rest, std::nullopt); };
  const auto keep = [&](Film& drawn, const Tile&) -> Status {
    whole.film = std::move(drawn);
    return Done{};
  };
  const Result<RenderedBands> rendered =
      draw(scene, tracer, settings, next, keep, observers.progress(), observers.cancel(), std::move(film));
  if (!rendered) return rendered.error();
  whole.rays = rendered->rays;
  whole.render_ms = rendered->render_ms;
  return whole;
}

bool is_drawn_whole(const RenderSettings& settings) {
  return settings.view == View::tree || settings.view == View::distance || settings.stereo.form != StereoForm::none;
}

Result<RenderedBands> render_parts(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                   const NextPart& next, const BandCallback& take, const ProgressCallback& progress,
                                   const CancelToken* cancel) {
  BIHIVE_CHECK(!is_drawn_whole(settings));
  const Observers observers(progress, cancel);
  return draw(scene, tracer, settings, next, take, observers.progress(), observers.cancel());
}

Result<RenderedBands> render_in_bands(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                      int band_rows, const BandCallback& take, const ProgressCallback& progress,
                                      const CancelToken* cancel) {
  BIHIVE_CHECK(band_rows >= 1);
  const Observers observers(progress, cancel);
  const Tile all = drawn_pixels(settings);
  if (settings.stereo.form != StereoForm::none) {
    const Result<Rendered> whole = render_stereo(scene, tracer, settings, observers.progress(), observers.cancel());
    if (!whole) return whole.error();
    if (Status status = take(whole->film, all); !status) return status.error();
    return RenderedBands{whole->rays, whole->render_ms};
  }
  const int rows = is_drawn_whole(settings) ? all.height() : band_rows;

  // The share of the picture above the band, and that of the band.
  double above = 0;
  double in_band = 0;
  ProgressCallback of_picture;
  if (observers.progress()) of_picture = [&](double done) { observers.progress()(above + done * in_band); };

  int y = all.y0;
  const auto next = [&]() -> std::optional<Tile> {
    if (y >= all.y1) return std::nullopt;
    const Tile band{all.x0, y, all.x1, std::min(y + rows, all.y1)};
    above = static_cast<double>(band.y0 - all.y0) / all.height();
    in_band = static_cast<double>(band.height()) / all.height();
    y = band.y1;
    return band;
  };
  return draw(scene, tracer, settings, next, take, of_picture, observers.cancel());
}

class SlicedPicture::Implementation {
 public:
  Implementation(std::unique_ptr<Drawing> drawing, int threads)
      : drawing_(std::move(drawing)), threads_(threads == 0 ? hardware_threads() : threads) {}

  void advance(double budget_ms) {
    const Timer timer;
    while (!finished()) {
      // Each thread takes tile after tile of one pass until the time is over, and none waits for another's tile.
      const std::size_t pass_end = (done_ / drawing_->tiles_in_a_pass() + 1) * drawing_->tiles_in_a_pass();
      drawing_->begin_pass(done_);
      std::atomic<std::size_t> next = done_;
      const auto draw_tiles = [&](std::int64_t) {
        do {
          const std::size_t tile = next.fetch_add(1);
          if (tile >= pass_end) return;
          drawing_->run_tile(tile);
        } while (timer.elapsed_ms() < budget_ms);
      };
      // A tile alone may have threads of its own.
      const std::int64_t at_once = std::min<std::int64_t>(threads_, static_cast<std::int64_t>(pass_end - done_));
      if (at_once == 1)
        draw_tiles(0);
      else
        parallel_for(threads_, at_once, draw_tiles);
      done_ = std::min(next.load(), pass_end);
      if (timer.elapsed_ms() >= budget_ms) break;
    }
    spent_ms_ += timer.elapsed_ms();
  }

  bool finished() const { return done_ == drawing_->tiles_in_all(); }
  double done() const { return static_cast<double>(done_) / static_cast<double>(drawing_->tiles_in_all()); }

  Rendered take() {
    BIHIVE_CHECK(finished());
    Result<Rendered> rendered = drawing_->take();
    rendered->render_ms = spent_ms_;
    return std::move(*rendered);
  }

 private:
  std::unique_ptr<Drawing> drawing_;
  int threads_;
  std::size_t done_ = 0;  // tiles
  double spent_ms_ = 0;
};

Result<SlicedPicture> SlicedPicture::begin(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                           Film film) {
  Result<std::unique_ptr<Drawing>> drawing = Drawing::begin(scene, tracer, settings);
  if (!drawing) return drawing.error();
  if (Status status = (*drawing)->start(drawn_pixels(settings), std::move(film)); !status) return status.error();
  return SlicedPicture(std::make_unique<Implementation>(std::move(*drawing), settings.threads));
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
