// Figures: PNG, TIFF and OpenEXR files with the metadata from which they can be rendered again and compared
// (job/picture_record.h).
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/image/exr.h"
#include "bihive/image/png_pixels.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_record.h"

namespace bihive {

/// The content of a file: pixels in the form of a PNG, or the channels of an OpenEXR file, sorted by name.
struct FigurePixels {
  PngPixels pixels;
  std::optional<ExrForm> exr{};
};

struct Figure {
  FigurePixels pixels;
  PictureRecord record;
};

/// Whether a path ends as those of such files do: .png, .tif, .tiff, .exr.
bool has_name_of_figure(const std::string& path);
/// Whether the file begins as such files do.
bool looks_like_figure(const std::string& path);

/// Fails if it is no such file, is a film, or has no record (then with kSaysNothing).
inline constexpr const char* kSaysNothing = "does not say how it was drawn";
Figure read_figure(const std::string& path);

/// The request for the figure at `path`; see the other function of this name.
PictureRequest request_again(const Figure& figure, const std::string& path, const std::string& input,
                             const std::vector<GivenSetting>& changes);

/// How a figure compares with the same picture rendered now.
struct Verdict {
  std::string figure;
  std::string drawn_by;                    ///< version and commit
  std::string error;                       ///< why it could not be drawn; empty: it was
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

/// Renders the figure again by `draw`, from `input` unless it is empty, and compares. `difference`: the file of a
/// picture of what differs; empty: none. What fails is in the verdict, except an interruption. `draw` gets the layers
/// of an OpenEXR file too; none: pixels are wanted.
using DrawFigure = std::function<FigurePixels(const PictureRequest&, const std::vector<std::string>& layers)>;
Verdict verify_figure(const std::string& path, const std::string& input, const std::string& difference,
                      const DrawFigure& draw);

/// What failed, as the verdict's error. Throws an interruption again.
void note_failure(const Failure& failure, Verdict& verdict);

/// "figure.png: the same bits", or all reasons why it does not hold.
std::string sentence_of(const Verdict& verdict);
nlohmann::ordered_json json_of(const Verdict& verdict);

}  // namespace bihive
