// Figures: PNG, TIFF and OpenEXR files with the metadata from which they can be rendered again and compared
// (job/picture_record.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bihive/job/picture_record.h"
#include "bihive/job/verdict.h"

namespace bihive {

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

/// Renders the figure again by `draw`, from `input` unless it is empty, and compares. `difference`: the file of a
/// picture of what differs; empty: none. What fails is in the verdict, except an interruption. `draw` gets the layers
/// of an OpenEXR file too; none: pixels are wanted.
using DrawFigure = std::function<FigurePixels(const PictureRequest&, const std::vector<std::string>& layers)>;
Verdict verify_figure(const std::string& path, const std::string& input, const std::string& difference,
                      const DrawFigure& draw);

}  // namespace bihive
