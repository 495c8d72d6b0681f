// Destinations of a film's pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bihive/image/png.h"
#include "film/film_plan.h"
#include "film/picture_numbers.h"

namespace bihive::cli {

class FilmFolder;

/// A finished picture. Numbers are positions in the film, from 0.
struct FilmPicture {
  std::int64_t number = 0;
  std::int64_t times = 1;  ///< as many missing positions, from `number` on, show it
  PngPixels pixels;
  PngText text;
};

/// All functions fail with a Failure; what is complete by then stays for the next run.
class FilmSink {
 public:
  virtual ~FilmSink() = default;

  /// Whether an earlier run has left the picture, complete and of the same film.
  virtual bool has(std::int64_t number) const = 0;
  /// Takes the next missing picture, in ascending order. From one thread. A sequence (in the end) and .y4m repeat
  /// pictures by themselves.
  virtual void add(const FilmPicture& picture) = 0;
  /// No more pictures come now: prepares what is complete for the next run, and leaves nothing if nothing is.
  virtual void pause() = 0;
  /// All pictures are there: the film gets its path.
  virtual void finish() = 0;
};

/// The kinds of films, by the output's ending.
enum class FilmKind { pictures, y4m, encoded };

/// Fails with kBadUsage on another ending, or on a sequence whose file name does not have its number in one place.
FilmKind film_kind(const std::string& output);

/// Whether it is a GIF or an APNG: an encoded film whose form has no choice of codecs.
bool is_animation(const std::string& output);

/// Fails with kBadUsage if the file to which the film's output leads has another ending.
void check_link_of_film(const std::string& link, const std::string& film);

/// The description's file beside the film: run.mp4.json, or film.json for run/%05d.png.
std::string plan_path(const std::string& output);

/// The path of one picture of a sequence.
std::string picture_path(const std::string& pattern, std::int64_t number);

/// The folder where a film is made: run.mp4.part.
std::string part_path(const std::string& output);

/// A picture of a shard there, until bihive film --join takes it.
std::string shard_picture_path(const std::string& output, std::int64_t number);

/// A film as PNG files.
struct SequenceForm {
  std::string output;
  bool store = false;         ///< pictures of a shard, which wait in part_path() for every kind
  Shard shard;                ///< that draws them
  PictureNumbers wanted;      ///< its pictures, where each is shown first
  PictureOrder order;         ///< where they are shown again; pictures of a shard are not
  std::int64_t pictures = 0;  ///< of the film, that are drawn
  double dots_per_inch = 0;   ///< as for encode_png()
};

/// All of these create the folder when the first picture comes. They fail if something else has the name of a picture.
std::unique_ptr<FilmSink> open_sequence(FilmFolder& film, SequenceForm form);
std::unique_ptr<FilmSink> open_y4m(const FilmPlan& plan, FilmFolder& film);
/// `ffmpeg`: the program's path.
std::unique_ptr<FilmSink> open_encoded(const FilmPlan& plan, const std::string& output, const std::string& ffmpeg,
                                       FilmFolder& film);

}  // namespace bihive::cli
