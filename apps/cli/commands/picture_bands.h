// A picture in bands of rows that several processes or threads draw in any order, and one writes from the top.
#pragma once

#include <cstdint>
#include <map>

#include "bihive/base/result.h"
#include "bihive/image/film.h"
#include "bihive/render/renderer.h"
#include "commands/picture_file.h"

namespace bihive::cli {

/// Several bands for each of those who draw, so that an expensive corner does not keep one of them alone. Low bands
/// cost more, because effects that look at neighbouring pixels draw the border of a band anew.
class PictureBands {
 public:
  PictureBands(const RenderSettings& settings, int who_draw);
  std::int64_t count() const { return (all_.height() + rows_ - 1) / rows_; }
  Tile pixels(std::int64_t number) const;

 private:
  Tile all_;
  int rows_;
};

/// Puts bands into the file in their order, and keeps those that come early.
class BandsInOrder {
 public:
  /// All must outlive it.
  BandsInOrder(const PictureBands& bands, PictureFile& file, const ProgressCallback& progress)
      : bands_(bands), file_(file), progress_(progress) {}

  void add(std::int64_t number, Film film);
  /// The first error of the file.
  const Status& status() const { return status_; }

 private:
  const PictureBands& bands_;
  PictureFile& file_;
  const ProgressCallback& progress_;
  std::map<std::int64_t, Film> early_;  // bands that wait for those above them
  std::int64_t written_ = 0;
  Status status_ = Done{};
};

}  // namespace bihive::cli
