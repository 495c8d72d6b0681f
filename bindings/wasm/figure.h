// A figure that proves itself, as the page's worker for figures calls it: its record, and the same picture drawn again.
// Answers are JSON texts (answers.h).
#pragma once

#include <emscripten/val.h>

#include <string>

#include "bihive/image/png_pixels.h"
#include "bihive/job/picture_record.h"

namespace bihive::page {

class Figure {
 public:
  /// The folder in which the files of the record are found by their names, with a slash at its end.
  static std::string folder();

  /// The record of the picture `name`: {"drawn_by": version and commit, "scene": a built-in one or "", "files":
  /// [{"option", "name", "sha256"}]}.
  std::string open(const std::string& name, const std::string& record);
  /// Draws it again. `progress` is called with the finished share, 0 to 1. {} or an error.
  std::string draw(const emscripten::val& progress);
  /// Compares pixels, as a PNG holds them: {"holds": bool, "words": the judgement}.
  std::string compare(int width, int height, int channels, int bits, const std::string& pixels);

 private:
  std::string name_;
  PictureRecord record_;
  PngPixels again_;
};

}  // namespace bihive::page
