// Parses the values of options. An error states the expected and the found text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/base/result.h"
#include "bihive/image/film.h"
#include "bihive/image/transfer.h"
#include "bihive/math/vec3.h"
#include "bihive/scene/turn.h"

namespace bihive {

struct PictureSize {
  int width_px, height_px;
};

Result<std::uint64_t> seed_from(const std::string& text);

/// "unlimited" (kUnlimited) or at least 1.
Result<std::int64_t> limit_from(const std::string& text);

/// "X,Y,Z", each within +-3.4e38.
Result<Vec3d> vector_from(const std::string& text);

/// "AZ,EL" or "AZ,EL,ROLL" in degrees, each within +-360.
Result<Turn> turn_from(const std::string& text);

/// "1280x720", each side 1 to 65535.
Result<PictureSize> size_from(const std::string& text);

/// A size in print, both sides above 0.
struct PrintSize {
  double width_in, height_in;
};

/// The same, or a size in print: "8.5cmx6cm" or "8.5x6cm", also in mm, in and pt.
Result<std::variant<PictureSize, PrintSize>> size_or_print_size_from(const std::string& text);

/// The pixels of a size in print. Error: a side has none, or more than 65535.
Result<PictureSize> size_of_print(const PrintSize& print, double dots_per_inch);

/// "X0,Y0,X1,Y1", whole numbers from 0 to 65535 with X0 < X1 and Y0 < Y1.
Result<Tile> crop_from(const std::string& text);

/// A whole number from 1 to `most`, or "auto" (kAutomaticSamples).
constexpr std::int64_t kAutomaticSamples = 0;
Result<std::int64_t> samples_from(const std::string& text, std::int64_t most);

/// A number above 0, "auto" (0), or the text of a selection.
using Focus = std::variant<double, std::string>;
Result<Focus> focus_from(const std::string& text);

/// "X,Y,Z", or the text of a selection.
using LookAt = std::variant<Vec3d, std::string>;
Result<LookAt> look_at_from(const std::string& text);

/// 8 or 16.
Result<std::int64_t> bits_from(const std::string& text);

/// A name, "#rrggbb" (both as seen on the screen under the transfer), or "r,g,b" (linear, each 0 to 1).
Result<Vec3d> colour_from(const std::string& text, Transfer transfer);

/// One of the names, by position.
template <class T>
Result<T> choice_from(const std::string& text, const std::vector<std::pair<std::string, T>>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names += (names.empty() ? "" : ", ") + name;
  }
  return unexpected("one of " + names, text);
}

}  // namespace bihive
