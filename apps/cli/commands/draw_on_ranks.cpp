#include "commands/draw_on_ranks.h"

#include <exception>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "commands/tiles_in_order.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

void stop_if_signalled() {
  if (CancellableSection::token().cancelled()) throw Interrupted{};
}

// Ranks above 0.
RenderCounts help(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, const PictureTiles& tiles,
                  PictureCommunicator& ranks) {
  RenderCounts rays;
  std::exception_ptr failure;
  try {
    std::int64_t number = 0;
    const auto next = [&]() -> std::optional<Tile> {
      number = ranks.next_number();
      if (number >= tiles.count()) return std::nullopt;
      return tiles.pixels(number);
    };
    const auto give = [&](const Film& film, const Tile&) -> Status {
      ranks.give(number, film);
      return Done{};
    };
    const auto while_drawing = [&](double) { ranks.move_on(); };
    Result<RenderedBands> rendered =
        render_parts(scene, tracer, settings, next, give, while_drawing, &CancellableSection::token());
    stop_if_signalled();
    rays = value_or_fail(std::move(rendered)).rays;
  } catch (...) {
    failure = std::current_exception();
  }
  ranks.end_giving({rays, {}}, failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  return rays;
}

// Rank 0, which draws too, and writes the tiles of all ranks in order.
class Leader {
 public:
  Leader(const PictureTiles& tiles, PictureFile& file, const ProgressCallback& progress, PictureCommunicator& ranks)
      : tiles_(tiles), in_order_(tiles, file, progress), ranks_(ranks) {}

  RenderCounts lead(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
    RenderCounts rays;
    std::exception_ptr failure;
    try {
      std::int64_t number = 0;
      const auto next = [&]() -> std::optional<Tile> {
        write_what_came();
        number = ranks_.next_number();
        if (number >= tiles_.count()) return std::nullopt;
        return tiles_.pixels(number);
      };
      const auto keep = [&](const Film& film, const Tile&) -> Status {
        add(number, film);
        return Done{};
      };
      const auto while_drawing = [&](double) { ranks_.move_on(); };
      Result<RenderedBands> rendered =
          render_parts(scene, tracer, settings, next, keep, while_drawing, &CancellableSection::token());
      stop_if_signalled();
      rays = value_or_fail(std::move(rendered)).rays;
    } catch (...) {
      failure = std::current_exception();
      ranks_.stop_counting();
    }
    while (std::optional<GivenTile> given = ranks_.take(/*wait=*/true)) {
      if (!failure) add(given->number, std::move(given->film));
      if (ranks_.somebody_failed()) ranks_.stop_counting();
    }
    if (failure) std::rethrow_exception(failure);
    if (!in_order_.status()) fail(in_order_.status().error());
    WorkOfRank work{rays, {}};
    work.add(ranks_.work_of_others());
    return work.rays;
  }

 private:
  void write_what_came() {
    while (std::optional<GivenTile> given = ranks_.take(/*wait=*/false)) add(given->number, std::move(given->film));
    if (ranks_.somebody_failed()) ranks_.stop_counting();
  }

  void add(std::int64_t number, Film film) {
    in_order_.add(number, std::move(film));
    if (!in_order_.status()) ranks_.stop_counting();
  }

  const PictureTiles& tiles_;
  TilesInOrder in_order_;
  PictureCommunicator& ranks_;
};

}  // namespace

Drawn draw_on_ranks(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile* file,
                    const ProgressCallback& progress, PictureCommunicator& ranks) {
  const Timer timer;
  ranks.begin_picture();
  const PictureTiles tiles(settings, ranks.size());
  const RenderCounts rays = file == nullptr ? help(scene, tracer, settings, tiles, ranks)
                                            : Leader(tiles, *file, progress, ranks).lead(scene, tracer, settings);
  Drawn drawn = drawn_with(rays);
  drawn.render_ms = timer.elapsed_ms();
  return drawn;
}

}  // namespace bihive::cli
