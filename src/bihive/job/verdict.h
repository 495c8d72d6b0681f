// How a figure compares with the same picture rendered now.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/image/exr.h"
#include "bihive/image/png_pixels.h"
#include "bihive/job/failure.h"

namespace bihive {

/// The content of a file: pixels in the form of a PNG, or the channels of an OpenEXR file, sorted by name.
struct FigurePixels {
  PngPixels pixels;
  std::optional<ExrForm> exr{};
};

struct Verdict {
  std::string figure;
  std::string drawn_by;                    ///< version and commit
  std::string error;                       ///< why it could not be drawn; empty: it was
  std::string built_in;                    ///< the built-in scene of which it was drawn; empty: of a file
  std::vector<std::string> changed_files;  ///< options of files with other bytes
  std::int64_t pixels_differ = 0;
  double largest = 0;           ///< difference of a channel, in its own steps; of OpenEXR as numbers
  std::int64_t x = -1, y = -1;  ///< the first pixel that differs
  bool edited = false;          ///< the file's pixels are not those that its record names
  bool same_form = true;        ///< size, channels and bits

  std::int64_t pictures = 0;  ///< of a film; 0: it is a picture
  std::int64_t pictures_differ = 0, first_picture = -1;
  bool coded = false;  ///< the film's pictures are coded with loss, and were compared as they were before that

  bool holds() const {
    return error.empty() && changed_files.empty() && pixels_differ == 0 && pictures_differ == 0 && same_form && !edited;
  }
};

/// SHA-256 as in the record.
std::string sha256_of(const FigurePixels& figure);

/// Compares the pixels of a figure with those of the same picture rendered now.
void compare(const FigurePixels& figure, const FigurePixels& again, Verdict& verdict);

/// Records the failure as the verdict's error. Rethrows an interruption.
void note_failure(const Failure& failure, Verdict& verdict);

/// "the same bits", or all reasons why it does not hold.
std::string judgement_of(const Verdict& verdict);
/// The same after the name of the figure: "figure.png: the same bits".
std::string sentence_of(const Verdict& verdict);
nlohmann::ordered_json json_of(const Verdict& verdict);

}  // namespace bihive
