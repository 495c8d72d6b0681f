#include "commands/draw_with_team.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <string_view>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/base/version.h"
#include "support/failure.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

// The picture in bands: several for each rank, so that an expensive corner does not keep one of them alone. Low bands
// cost more, because effects that look at neighbouring pixels draw the border of a band anew.
class Bands {
 public:
  Bands(const RenderSettings& settings, int ranks) : all_(drawn_pixels(settings)) {
    constexpr int kOfEachRank = 8, kLeastRows = 16, kMostRows = 64;
    rows_ = std::clamp(all_.height() / (kOfEachRank * ranks), kLeastRows, kMostRows);
  }
  std::int64_t count() const { return (all_.height() + rows_ - 1) / rows_; }
  Tile pixels(std::int64_t number) const {
    const int y = all_.y0 + static_cast<int>(number) * rows_;
    return {all_.x0, y, all_.x1, std::min(y + rows_, all_.y1)};
  }

 private:
  Tile all_;
  int rows_;
};

void stop_if_signalled() {
  if (CancellableSection::token().cancelled()) throw Interrupted{};
}

RenderCounts sum(const RenderCounts& a, const RenderCounts& b) {
  return {a.primary + b.primary, a.shadow + b.shadow, a.reflected + b.reflected, a.transmitted + b.transmitted,
          a.ambient + b.ambient};
}

// Ranks above 0.
RenderCounts help(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, const Bands& bands,
                  Team& team) {
  RenderCounts rays;
  std::exception_ptr failure;
  try {
    std::int64_t number = 0;
    const auto next = [&]() -> std::optional<Tile> {
      number = team.next_number();
      if (number >= bands.count()) return std::nullopt;
      return bands.pixels(number);
    };
    const auto give = [&](const Film& film, const Tile&) -> Status {
      team.give(number, film);
      return Done{};
    };
    Result<RenderedBands> rendered =
        render_bands(scene, tracer, settings, next, give, {}, &CancellableSection::token());
    stop_if_signalled();
    rays = value_or_fail(std::move(rendered)).rays;
  } catch (...) {
    failure = std::current_exception();
  }
  team.end_giving(rays, failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  return rays;
}

// Rank 0, which draws too, and puts the bands of all into the file in their order.
class Leader {
 public:
  Leader(const Bands& bands, PictureFile& file, const ProgressCallback& progress, Team& team)
      : bands_(bands), file_(file), progress_(progress), team_(team) {}

  RenderCounts lead(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
    RenderCounts rays;
    std::exception_ptr failure;
    try {
      std::int64_t number = 0;
      const auto next = [&]() -> std::optional<Tile> {
        write_what_came();
        number = team_.next_number();
        if (number >= bands_.count()) return std::nullopt;
        return bands_.pixels(number);
      };
      const auto keep = [&](const Film& film, const Tile&) -> Status {
        add(number, film);
        return Done{};
      };
      // The other ranks wait for whoever receives, so that goes on while this one draws.
      const auto while_drawing = [&](double) { team_.receive(); };
      Result<RenderedBands> rendered =
          render_bands(scene, tracer, settings, next, keep, while_drawing, &CancellableSection::token());
      stop_if_signalled();
      rays = value_or_fail(std::move(rendered)).rays;
    } catch (...) {
      failure = std::current_exception();
      team_.stop_counting();
    }
    while (std::optional<GivenRows> given = team_.take(/*wait=*/true)) {
      if (!failure) add(given->number, std::move(given->film));
      if (team_.somebody_failed()) team_.stop_counting();
    }
    if (failure) std::rethrow_exception(failure);
    if (!status_) fail(status_.error());
    return sum(rays, team_.rays_of_others());
  }

 private:
  void write_what_came() {
    while (std::optional<GivenRows> given = team_.take(/*wait=*/false)) add(given->number, std::move(given->film));
    if (team_.somebody_failed()) team_.stop_counting();
  }

  void add(std::int64_t number, Film film) {
    early_.emplace(number, std::move(film));
    for (auto first = early_.begin(); first != early_.end() && first->first == written_; first = early_.begin()) {
      if (status_) status_ = file_.add(first->second, bands_.pixels(written_));
      if (!status_) team_.stop_counting();
      early_.erase(first);
      ++written_;
    }
    progress_(static_cast<double>(written_) / static_cast<double>(bands_.count()));
  }

  const Bands& bands_;
  PictureFile& file_;
  const ProgressCallback& progress_;
  Team& team_;
  std::map<std::int64_t, Film> early_;  // bands that wait for those above them
  std::int64_t written_ = 0;
  Status status_ = Done{};
};

// 64-bit FNV-1a.
class Hash {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* const at = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ at[i]) * 0x100000001b3;
  }
  void add(double number) { add(&number, sizeof number); }
  template <class T>
  void add(const std::vector<T>& numbers) {
    add(numbers.data(), numbers.size() * sizeof(T));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace

Drawn draw_with_team(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile* file,
                     const ProgressCallback& progress, Team& team) {
  const Timer timer;
  const Bands bands(settings, team.size());
  const RenderCounts rays = file == nullptr ? help(scene, tracer, settings, bands, team)
                                            : Leader(bands, *file, progress, team).lead(scene, tracer, settings);
  Drawn drawn = drawn_with(rays);
  drawn.render_ms = timer.elapsed_ms();
  return drawn;
}

std::vector<Fingerprint> fingerprints_of(const Scene& scene, const std::string& described) {
  Hash program, spheres, settings;
  for (const std::string_view text : {version(), commit()}) program.add(text.data(), text.size());
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    const Vec3d centre = scene.spheres.centre(id);
    for (const double number : {centre.x, centre.y, centre.z, scene.spheres.radius(id)}) spheres.add(number);
  }
  const SphereAttributes& attributes = scene.spheres.attributes();
  spheres.add(attributes.colour);
  spheres.add(attributes.opacity);
  spheres.add(attributes.element);
  spheres.add(attributes.type);
  settings.add(described.data(), described.size());
  return {{"the program", program.value()}, {"the input", spheres.value()}, {"the options", settings.value()}};
}

}  // namespace bihive::cli
