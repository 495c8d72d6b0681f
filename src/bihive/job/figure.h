// Figures: PNG files with the metadata from which they can be rendered again and compared (job/picture_record.h).
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/image/png_pixels.h"
#include "bihive/job/picture_record.h"

namespace bihive {

struct Figure {
  PngPixels pixels;
  PictureRecord record;
};

/// Fails if it is no PNG, or has no record.
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
  int largest = 0;              ///< difference of a channel, in its own steps
  std::int64_t x = -1, y = -1;  ///< the first pixel that differs
  bool edited = false;          ///< the file's pixels are not those that its record names
  bool same_form = true;        ///< size, channels and bits

  bool holds() const { return error.empty() && changed_files.empty() && pixels_differ == 0 && same_form && !edited; }
};

/// Renders the figure again by `draw`, from `input` unless it is empty, and compares. `difference`: the file of a
/// picture of what differs; empty: none. What fails is in the verdict, except an interruption.
Verdict verify_figure(const std::string& path, const std::string& input, const std::string& difference,
                      const std::function<PngPixels(const PictureRequest&)>& draw);

/// "figure.png: the same bits", or all reasons why it does not hold.
std::string sentence_of(const Verdict& verdict);
nlohmann::ordered_json json_of(const Verdict& verdict);

}  // namespace bihive
