#include "bihive/job/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/bih/tree.h"
#include "bihive/image/colour_text.h"
#include "bihive/math/vector_text.h"
#include "bihive/select/selection.h"
#include "bihive/settings/picture_settings.h"

namespace bihive {
namespace {

// Parses a whole number without a plus sign; the whole text must be it.
template <class T>
std::optional<T> whole(std::string_view text) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// A number, and the inches of the unit after it; 0: none.
struct Length {
  double number = 0, unit_in = 0;
};
Length length_in(std::string_view text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"cm", 1 / 2.54}, {"mm", 1 / 25.4}, {"in", 1}, {"pt", 1 / kPointsPerInch}};
  Length length;
  for (const auto& [name, inches] : kUnits)
    if (text.size() > name.size() && text.substr(text.size() - name.size()) == name) {
      length.unit_in = inches;
      text.remove_suffix(name.size());
    }
  length.number = parse_double(text).value_or(0);
  return length;
}

}  // namespace

Result<std::uint64_t> seed_from(const std::string& text) {
  const std::optional<std::uint64_t> value = whole<std::uint64_t>(text);
  if (value) return *value;
  return unexpected("a whole number from 0 to 18446744073709551615", text);
}

Result<std::int64_t> limit_from(const std::string& text) {
  if (text == "unlimited") return kUnlimited;
  const std::optional<std::int64_t> value = whole<std::int64_t>(text);
  if (value && *value >= 1) return *value;
  return unexpected("a whole number of at least 1 or \"unlimited\"", text);
}

Result<Vec3d> vector_from(const std::string& text) {
  constexpr double kLargest = 3.4e38;
  if (const std::optional<Vec3d> v = vector_from_text(text, -kLargest, kLargest)) return *v;
  return unexpected("three numbers X,Y,Z", text);
}

Result<Turn> turn_from(const std::string& text) {
  constexpr double kMost = 360;
  const std::vector<double> degrees = numbers_from_text(text);
  const bool in_range =
      std::all_of(degrees.begin(), degrees.end(), [](double number) { return std::abs(number) <= kMost; });
  if (in_range && (degrees.size() == 2 || degrees.size() == 3))
    return Turn{degrees[0], degrees[1], degrees.size() == 3 ? degrees[2] : 0};
  return unexpected("degrees AZ,EL or AZ,EL,ROLL, each from -360 to 360", text);
}

Result<PictureSize> size_from(const std::string& text) {
  const std::size_t times = text.find('x');
  if (times != std::string::npos) {
    const std::optional<int> width = whole<int>(std::string_view(text).substr(0, times));
    const std::optional<int> height = whole<int>(std::string_view(text).substr(times + 1));
    if (width && height && *width >= 1 && *height >= 1 && *width <= kMostSidePx && *height <= kMostSidePx)
      return PictureSize{*width, *height};
  }
  return unexpected("WIDTHxHEIGHT in pixels, each from 1 to 65535", text);
}

Result<std::variant<PictureSize, PrintSize>> size_or_print_size_from(const std::string& text) {
  if (const Result<PictureSize> pixels = size_from(text)) return std::variant<PictureSize, PrintSize>(*pixels);
  const std::size_t times = text.find('x');
  if (times != std::string::npos) {
    const Length width = length_in(std::string_view(text).substr(0, times));
    const Length height = length_in(std::string_view(text).substr(times + 1));
    const double inches = width.unit_in > 0 ? width.unit_in : height.unit_in;
    if (width.number > 0 && height.number > 0 && height.unit_in > 0)
      return std::variant<PictureSize, PrintSize>(PrintSize{width.number * inches, height.number * height.unit_in});
  }
  return unexpected("WIDTHxHEIGHT in pixels, each from 1 to 65535, or in print, such as 8.5x6cm (cm, mm, in, pt)",
                    text);
}

Result<PictureSize> size_of_print(const PrintSize& print, double dots_per_inch) {
  const double width = std::round(print.width_in * dots_per_inch);
  const double height = std::round(print.height_in * dots_per_inch);
  if (width >= 1 && height >= 1 && width <= kMostSidePx && height <= kMostSidePx)
    return PictureSize{static_cast<int>(width), static_cast<int>(height)};
  return Error{fmt::format("a picture of {:g} x {:g} inches at {:g} pixels per inch has {:.0f} x {:.0f} pixels; each "
                           "side has 1 to 65535",
                           print.width_in, print.height_in, dots_per_inch, width, height),
               "", 0, 0, ""};
}

Result<Tile> crop_from(const std::string& text) {
  std::vector<int> n;
  for (const std::string_view part : parts_of(text, ',')) n.push_back(whole<int>(part).value_or(-1));
  if (n.size() == 4 && n[0] >= 0 && n[1] >= 0 && n[0] < n[2] && n[1] < n[3] && n[2] <= kMostSidePx &&
      n[3] <= kMostSidePx)
    return Tile{n[0], n[1], n[2], n[3]};
  return unexpected("four whole numbers X0,Y0,X1,Y1 from 0 to 65535, X0 below X1 and Y0 below Y1", text);
}

Result<std::int64_t> samples_from(const std::string& text, std::int64_t most) {
  if (text == "auto") return kAutomaticSamples;
  const std::optional<std::int64_t> value = whole<std::int64_t>(text);
  if (value && *value >= 1 && *value <= most) return *value;
  return unexpected("a whole number from 1 to " + std::to_string(most) + " or \"auto\"", text);
}

Result<Focus> focus_from(const std::string& text) {
  if (text == "auto") return Focus(0.0);
  const std::optional<double> value = parse_double(text);
  if (value && *value > 0 && *value <= double(std::numeric_limits<float>::max())) return Focus(*value);
  if (!value && check_selection(text)) return Focus(text);
  return unexpected("a number above 0 and up to 3.4e38, \"auto\" or a selection", text);
}

Result<LookAt> look_at_from(const std::string& text) {
  if (const Result<Vec3d> point = vector_from(text)) return LookAt(*point);
  if (!vector_from_text(text) && check_selection(text)) return LookAt(text);
  return unexpected("three numbers X,Y,Z or a selection", text);
}

Result<std::int64_t> bits_from(const std::string& text) {
  const std::optional<std::int64_t> bits = whole<std::int64_t>(text);
  if (bits && (*bits == 8 || *bits == 16)) return *bits;
  return unexpected("8 or 16", text);
}

Result<Vec3d> colour_from(const std::string& text, Transfer transfer) {
  if (const std::optional<Vec3d> colour = colour_from_text(text, transfer)) return *colour;
  if (const std::optional<Vec3d> light = vector_from_text(text, 0, 1)) return *light;
  return unexpected("#rrggbb, r,g,b with numbers from 0 to 1, or one of " + std::string(kColourNames), text);
}

}  // namespace bihive
