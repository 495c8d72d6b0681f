#include "commands/draw_spread.h"

#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "commands/tiles_in_order.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

// Threads that draw wait for other ranks half of the time.
constexpr int kDrawingForEachThread = 2;

int drawing_threads(const RenderSettings& settings) {
  return kDrawingForEachThread * settings.threads;
}

void stop_if_asked() {
  if (CancellableSection::token().cancelled()) throw Interrupted{};
}

// The threads of this rank that draw tiles.
class DrawingThreads {
 public:
  DrawingThreads(const SpreadScene& spread, const RenderSettings& settings, const PictureTiles& tiles,
                 TileChannel& channel)
      : spread_(spread), settings_(settings), tiles_(tiles), channel_(channel) {
    settings_.threads = 1;
  }

  void run(int count) {
    for (int i = 0; i < count; ++i) threads_.emplace_back([this] { draw(); });
  }
  /// Joins them.
  void join() {
    for (std::thread& thread : threads_) thread.join();
  }
  const WorkOfRank& work() const { return work_; }
  const std::exception_ptr& failure() const { return failure_; }

 private:
  void draw() {
    try {
      const std::unique_ptr<SpreadScene::Artist> artist = spread_.artist(channel_);
      std::int64_t number = 0;
      const auto next = [&]() -> std::optional<Tile> {
        artist->rest();
        number = channel_.next_number();
        if (number >= tiles_.count()) return std::nullopt;
        return tiles_.pixels(number);
      };
      const auto give = [&](const Film& film, const Tile&) -> Status {
        channel_.give(number, film);
        return Done{};
      };
      Result<RenderedBands> rendered =
          render_parts(artist->scene(), artist->tracer(), settings_, next, give, {}, &CancellableSection::token());
      stop_if_asked();
      const RenderCounts rays = value_or_fail(std::move(rendered)).rays;
      const std::lock_guard lock(mutex_);
      work_.add({rays, artist->counts()});
    } catch (...) {
      channel_.stop_counting();
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  const SpreadScene& spread_;
  RenderSettings settings_;
  const PictureTiles& tiles_;
  TileChannel& channel_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  WorkOfRank work_;
  std::exception_ptr failure_;
};

// The signal that stopped a thread is more informative than its missing answer.
void rethrow(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const ChannelClosed&) {
    stop_if_asked();
  }
}

}  // namespace

Drawn draw_spread(const SpreadScene& spread, const RenderSettings& settings, PictureFile* file,
                  const ProgressCallback& progress, PictureCommunicator& ranks, TileChannel& channel) {
  const Timer timer;
  const PictureTiles tiles(settings, ranks.size() * drawing_threads(settings));
  DrawingThreads drawing(spread, settings, tiles, channel);
  drawing.run(drawing_threads(settings));
  Drawn drawn;
  Status written = Done{};
  std::exception_ptr failure;
  if (file == nullptr) {
    drawing.join();
    channel.end_giving(drawing.work(), drawing.failure() != nullptr);
    drawn = drawn_with(drawing.work().rays);
  } else {
    // This rank's threads may end while this one writes.
    std::thread end_of_own([&] {
      drawing.join();
      channel.end_own_giving();
    });
    TilesInOrder in_order(tiles, *file, progress);
    try {
      while (std::optional<GivenTile> given = channel.take(/*wait=*/true)) {
        if (!failure) in_order.add(given->number, std::move(given->film));
        if (!in_order.status() || channel.somebody_failed()) channel.stop_counting();
      }
    } catch (...) {
      // A layer that needs other ranks ends with them.
      failure = std::current_exception();
      channel.stop_counting();
      while (channel.take(/*wait=*/true)) {
      }
    }
    end_of_own.join();
    written = in_order.status();
    WorkOfRank work = drawing.work();
    work.add(channel.work_of_others());
    drawn = drawn_with(work.rays);
    drawn.exchange = {{"rays", work.cost.rays},
                      {"asked", work.cost.asked},
                      {"messages", work.cost.messages},
                      {"bytes", work.cost.bytes},
                      {"rounds", work.cost.rounds}};
  }
  channel.end();
  if (drawing.failure()) failure = drawing.failure();
  if (failure) rethrow(failure);
  stop_if_asked();
  if (!written) fail(written.error());
  drawn.render_ms = timer.elapsed_ms();
  return drawn;
}

Drawn draw_spread_alone(const SpreadScene::Artist& artist, RenderEngine engine, const RenderSettings& settings,
                        const std::vector<Layer>& layers, PictureFile* file, const ProgressCallback& progress,
                        TileChannel& channel) {
  Drawn drawn;
  std::exception_ptr failure;
  RenderSettings of_one_thread = settings;
  of_one_thread.threads = 1;
  if (file == nullptr) {
    channel.end_giving({}, false);
  } else {
    try {
      drawn = draw_picture(artist.scene(), artist.tracer(), engine, of_one_thread, layers, *file, progress);
    } catch (...) {
      failure = std::current_exception();
    }
    channel.end_own_giving();
    while (channel.take(/*wait=*/true)) {
    }
  }
  channel.end();
  if (failure) rethrow(failure);
  stop_if_asked();
  return drawn;
}

}  // namespace bihive::cli
