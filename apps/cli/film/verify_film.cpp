#include "film/verify_film.h"

#include <filesystem>
#include <map>
#include <utility>

#include "bihive/base/path_parts.h"
#include "bihive/base/version.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_options.h"
#include "commands/names.h"
#include "film/codec_words.h"
#include "film/film_plan.h"
#include "film/film_record.h"
#include "words/given_options.h"

namespace bihive::cli {
namespace {

struct RecordedFilm {
  PictureRecord record;
  FilmPlan plan;
};

RecordedFilm read_film(const std::string& path) {
  const std::string text = read_film_record(path);
  if (text.empty())
    fail({kSaysNothing, path, 0, 0, "bihive film writes that into its films, unless it is told not to"});
  Result<PictureRecord> record = picture_record_from(text);
  const bool is_film = record && !record->film.empty();
  if (!is_film)
    fail({record ? "its record of how it was drawn is damaged" : record.error().message, path, 0, 0,
          record ? "" : record.error().hint});
  FilmPlan plan = plan_of_record(*record, path);
  return {std::move(*record), std::move(plan)};
}

}  // namespace

Verdict verify_film(const std::string& path, const std::string& input, const DrawFigure& draw) {
  Verdict verdict;
  verdict.figure = path;
  try {
    const auto [record, plan] = read_film(path);
    verdict.drawn_by = version_with_commit(record.version, record.commit);
    verdict.built_in = record.built_in;
    verdict.pictures = plan.positions();
    verdict.coded = !is_without_loss(path);
    if (static_cast<std::int64_t>(record.pictures_sha256.size()) != verdict.pictures)
      fail({"its record of how it was drawn is damaged", path, 0, 0, ""});
    if (!verdict.coded) verdict.edited = sha256_of_pictures(path) != record.pictures_sha256;
    const PictureRequest request = request_again(record, folder_of(path), input, {});
    verdict.changed_files = changed_files(record, request);

    // Each picture once, however often it is shown.
    std::map<std::int64_t, std::string> drawn;
    for (std::int64_t position = 0; position < verdict.pictures; ++position) {
      std::string& digits = drawn[plan.picture_at(position)];
      if (digits.empty()) {
        RenderOptions picture;
        static_cast<PictureRequest&>(picture) = request;
        picture.picture_of_film = position;
        take_film(picture, plan);
        digits = sha256_of(draw(picture, {}).pixels);
      }
      if (digits == record.pictures_sha256[static_cast<std::size_t>(position)]) continue;
      if (verdict.pictures_differ++ == 0) verdict.first_picture = position;
    }
  } catch (const Failure& failure) {
    note_failure(failure, verdict);
  }
  return verdict;
}

FilmOptions film_again(const std::string& path, const RenderOptions& changes) {
  const auto [record, plan] = read_film(path);
  const FilmPlan::Asked& asked = plan.asked;
  FilmOptions film;
  film.picture = changes;
  static_cast<PictureRequest&>(film.picture) =
      request_again(record, folder_of(path), changes.input.input, changes.given);
  film.words = picture_words(film.picture.given);
  if (asked.frames.count == 1) film.pictures = asked.pictures;
  film.frames = FrameRange{asked.frames.first, asked.frames.frame(asked.frames.count - 1) + 1, asked.frames.step};
  film.order = asked.order;
  film.rate = asked.rate;
  film.turntable_deg = asked.path.turntable_deg;
  film.keys = asked.path.keys;
  film.turn_axis = asked.turn_axis;
  film.follow = asked.follow;
  film.align = asked.align;
  film.fit_frames = *value_named(kFittedFrames, asked.fit_frames);
  film.range_of_colours = *value_named(kRangesOfColours, asked.range_of_colours);
  film.codec = asked.codec;
  if (const Status status = check_codec_of_file(film.codec); !status)
    fail({status.error().message, path, 0, 0, "make the film by bihive film"});
  return film;
}

}  // namespace bihive::cli
