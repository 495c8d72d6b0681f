// A film as PNG files: the sequence that the user asked for, or the pictures of a shard.

#include <unistd.h>

#include <utility>

#include "bihive/base/write_file.h"
#include "film/film_sink.h"
#include "support/failure.h"

namespace bihive::cli {
namespace {

class PictureSequence final : public FilmSink {
 public:
  PictureSequence(std::string output, bool store, double dots_per_inch)
      : output_(std::move(output)), store_(store), dots_per_inch_(dots_per_inch) {}

  // A picture is written whole or not at all, and the film's description is that of this film.
  bool has(std::int64_t number) const override { return access(path_of(number).c_str(), F_OK) == 0; }

  void add(const FilmPicture& picture) override {
    const std::string bytes = value_or_fail(encode_png(picture.pixels, picture.text, dots_per_inch_));
    value_or_fail(write_file(path_of(picture.number), bytes));
  }

  void pause() override {}
  void finish() override {}

 private:
  std::string path_of(std::int64_t number) const {
    return store_ ? shard_picture_path(output_, number) : picture_path(output_, number);
  }

  std::string output_;
  bool store_;
  double dots_per_inch_;
};

}  // namespace

std::unique_ptr<FilmSink> open_sequence(const FilmPlan&, const std::string& output, bool store, double dots_per_inch) {
  return std::make_unique<PictureSequence>(output, store, dots_per_inch);
}

}  // namespace bihive::cli
