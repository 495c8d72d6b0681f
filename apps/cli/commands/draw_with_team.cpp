#include "commands/draw_with_team.h"

#include <exception>
#include <utility>

#include "bihive/base/timer.h"
#include "commands/tiles_in_order.h"
#include "support/failure.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

void stop_if_signalled() {
  if (CancellableSection::token().cancelled()) throw Interrupted{};
}

// Ranks above 0.
RenderCounts help(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, const PictureTiles& tiles,
                  Team& team) {
  RenderCounts rays;
  std::exception_ptr failure;
  try {
    std::int64_t number = 0;
    const auto next = [&]() -> std::optional<Tile> {
      number = team.next_number();
      if (number >= tiles.count()) return std::nullopt;
      return tiles.pixels(number);
    };
    const auto give = [&](const Film& film, const Tile&) -> Status {
      team.give(number, film);
      return Done{};
    };
    const auto while_drawing = [&](double) { team.move_on(); };
    Result<RenderedBands> rendered =
        render_parts(scene, tracer, settings, next, give, while_drawing, &CancellableSection::token());
    stop_if_signalled();
    rays = value_or_fail(std::move(rendered)).rays;
  } catch (...) {
    failure = std::current_exception();
  }
  team.end_giving({rays, {}}, failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  return rays;
}

// Rank 0, which draws too, and puts the tiles of all into the file in their order.
class Leader {
 public:
  Leader(const PictureTiles& tiles, PictureFile& file, const ProgressCallback& progress, Team& team)
      : tiles_(tiles), in_order_(tiles, file, progress), team_(team) {}

  RenderCounts lead(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
    RenderCounts rays;
    std::exception_ptr failure;
    try {
      std::int64_t number = 0;
      const auto next = [&]() -> std::optional<Tile> {
        write_what_came();
        number = team_.next_number();
        if (number >= tiles_.count()) return std::nullopt;
        return tiles_.pixels(number);
      };
      const auto keep = [&](const Film& film, const Tile&) -> Status {
        add(number, film);
        return Done{};
      };
      const auto while_drawing = [&](double) { team_.move_on(); };
      Result<RenderedBands> rendered =
          render_parts(scene, tracer, settings, next, keep, while_drawing, &CancellableSection::token());
      stop_if_signalled();
      rays = value_or_fail(std::move(rendered)).rays;
    } catch (...) {
      failure = std::current_exception();
      team_.stop_counting();
    }
    while (std::optional<GivenTile> given = team_.take(/*wait=*/true)) {
      if (!failure) add(given->number, std::move(given->film));
      if (team_.somebody_failed()) team_.stop_counting();
    }
    if (failure) std::rethrow_exception(failure);
    if (!in_order_.status()) fail(in_order_.status().error());
    WorkOfRank work{rays, {}};
    work.add(team_.work_of_others());
    return work.rays;
  }

 private:
  void write_what_came() {
    while (std::optional<GivenTile> given = team_.take(/*wait=*/false)) add(given->number, std::move(given->film));
    if (team_.somebody_failed()) team_.stop_counting();
  }

  void add(std::int64_t number, Film film) {
    in_order_.add(number, std::move(film));
    if (!in_order_.status()) team_.stop_counting();
  }

  const PictureTiles& tiles_;
  TilesInOrder in_order_;
  Team& team_;
};

}  // namespace

Drawn draw_with_team(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile* file,
                     const ProgressCallback& progress, Team& team) {
  const Timer timer;
  team.begin_picture();
  const PictureTiles tiles(settings, team.size());
  const RenderCounts rays = file == nullptr ? help(scene, tracer, settings, tiles, team)
                                            : Leader(tiles, *file, progress, team).lead(scene, tracer, settings);
  Drawn drawn = drawn_with(rays);
  drawn.render_ms = timer.elapsed_ms();
  return drawn;
}

}  // namespace bihive::cli
