// The files from which bihive film goes on, of any bytes: the description, the codec in it, and the index of a
// sequence. What is accepted is written and read again the same; all else is an error of one line.
#include "bihive/job/failure.h"
#include "film/codec_words.h"
#include "film/film_plan.h"
#include "film/picture_index.h"
#include "read_and_check.h"

namespace {

using namespace bihive;

constexpr std::uint64_t kFilm = 0x0123456789abcdef;

void check_plan(const std::string& text) {
  cli::FilmPlan plan;
  try {
    plan = cli::parse_film_plan(text, "film.json");
  } catch (const Failure& failure) {
    fuzz::require(failure.code == kBadInput);
    return fuzz::check_error(failure.error);
  }
  const cli::FilmPlan::Asked& asked = plan.asked;
  fuzz::require(asked.pictures >= 1 && asked.pictures <= plan.positions() && plan.positions() <= cli::kMostPictures);
  for (const std::int64_t k : {std::int64_t{0}, plan.positions() / 2, plan.positions() - 1})
    fuzz::require(plan.picture_at(k) >= 0 && plan.picture_at(k) < asked.pictures && plan.first_position(k) <= k);
  fuzz::require(plan.fixed.width_px >= 1 && plan.fixed.height_px >= 1);
  fuzz::require(plan.frame_of(0) >= 0 && plan.frame_of(asked.pictures - 1) >= plan.frame_of(0));
  if (const Status status = cli::check_codec_of_file(asked.codec); !status) fuzz::check_error(status.error());
  const std::string written = cli::film_plan_to_json(plan);
  const cli::FilmPlan again = cli::parse_film_plan(written, "film.json");
  fuzz::require(cli::film_plan_to_json(again) == written && cli::difference(asked, again.asked).empty());
}

void check_index(std::string_view text) {
  const auto index = cli::read_index(text, kFilm);
  if (!index) return;
  std::string written = cli::index_head(kFilm + 1);
  for (const cli::IndexEntry& entry : index->earlier) written += cli::index_line(entry);
  written += cli::index_head(kFilm);
  for (const cli::IndexEntry& entry : index->own) written += cli::index_line(entry);
  const auto again = cli::read_index(written, kFilm);
  fuzz::require(again && again->own == index->own && again->earlier == index->earlier && again->ends_with_own);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check_plan(text);
  check_index(text);
  return 0;
}
