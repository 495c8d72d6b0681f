#include "bihive/scene/colour_by.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/base/parse_number.h"
#include "bihive/geometry/each_sphere.h"
#include "bihive/image/colour_text.h"
#include "bihive/math/elementary.h"
#include "bihive/scene/colour_of_number.h"
#include "bihive/scene/palette.h"
#include "bihive/select/attribute_names.h"
#include "bihive/select/number_term.h"

namespace bihive {
namespace {

Error colour_by_error(const std::string& message, const std::string& hint = "") {
  return {message, "", 0, 0, hint};
}

// Without the part up to the next colon, which it returns.
std::string take_part(std::string& rest) {
  const std::size_t colon = rest.find(':');
  const std::string part = rest.substr(0, colon);
  rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  return part;
}

// "MIN,MAX" or "P%,Q%", with the larger one first or last, into `how`.
bool take_range(const std::string& text, ColourBy& how) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return false;
  std::string_view first = std::string_view(text).substr(0, comma), second = std::string_view(text).substr(comma + 1);
  const bool of_percent = first.ends_with('%') && second.ends_with('%');
  if (of_percent) first.remove_suffix(1), second.remove_suffix(1);
  const auto low = parse_double(first), high = parse_double(second);
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || *low == *high) return false;
  if (of_percent && (std::min(*low, *high) < 0 || std::max(*low, *high) > 100)) return false;
  (of_percent ? how.percentiles : how.range).emplace(std::min(*low, *high), std::max(*low, *high));
  if (*low > *high) how.map = reversed(how.map.value_or(ColourMap()));
  return true;
}

// A colour that looks the same under both transfers.
Vec3f as_seen(Vec3f linear, Transfer transfer) {
  if (transfer == Transfer::srgb) return linear;
  for (int channel = 0; channel < 3; ++channel)
    linear[channel] = static_cast<float>(srgb_from_linear(double(linear[channel])));
  return linear;
}

// The place of a number in a range, 0 to 1 inside of it; NaN: unknown.
class Scale {
 public:
  Scale(std::pair<double, double> range, bool logarithmic) : logarithmic_(logarithmic) {
    low_ = along(range.first);
    high_ = along(range.second);
  }
  double share(double number) const {
    const double place = along(number);
    if (std::isnan(place) || std::isinf(place)) return place;
    if (!(low_ < high_)) return 0.5;
    // Halves, so that no difference overflows.
    return (place / 2 - low_ / 2) / (high_ / 2 - low_ / 2);
  }

 private:
  double along(double number) const {
    if (!logarithmic_) return number;
    if (number <= 0) return -std::numeric_limits<double>::infinity();
    return std::isfinite(number) ? portable_log2(number) : number;
  }

  bool logarithmic_;
  double low_, high_;
};

// use(number) for each finite number of the spheres in the mask, and of their images where these differ; with a
// logarithmic scale above 0.
template <class Use>
void for_each_number(const SphereSet& spheres, const FoundAttribute& attribute, const std::vector<std::uint8_t>& mask,
                     bool logarithmic, const Use& use) {
  const auto add = [&](std::int64_t id) {
    if (mask[static_cast<std::size_t>(spheres.stored_id(id))] == 0) return;
    const double number = attribute.number_of(spheres, id);
    if (std::isfinite(number) && (!logarithmic || number > 0)) use(number);
  };
  if (spheres.has_images() && attribute.differs_by_image())
    for_each_sphere(spheres, [&](std::int64_t id, Vec3d, double) { add(id); });
  else
    for (std::int64_t id = 0; id < spheres.size(); ++id) add(id);
}

// The value below which `percent` of the numbers lie, between two of them in proportion. Reorders them.
double percentile(std::vector<double>& numbers, double percent) {
  const double place = percent / 100 * static_cast<double>(numbers.size() - 1);
  const auto below = numbers.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(numbers.begin(), below, numbers.end());
  const double weight = place - std::floor(place);
  if (weight == 0) return *below;
  return (1 - weight) * *below + weight * *std::min_element(below + 1, numbers.end());
}

// The range of an open one: the smallest and largest number, or the percentiles.
std::optional<std::pair<double, double>> range_of(const SphereSet& spheres, const ColourBy& how,
                                                  const FoundAttribute& attribute,
                                                  const std::vector<std::uint8_t>& mask) {
  if (how.percentiles) {
    std::vector<double> numbers;
    for_each_number(spheres, attribute, mask, how.logarithmic, [&](double number) { numbers.push_back(number); });
    if (numbers.empty()) return std::nullopt;
    const double low = percentile(numbers, how.percentiles->first);
    return std::pair{low, percentile(numbers, how.percentiles->second)};
  }
  std::optional<std::pair<double, double>> range;
  for_each_number(spheres, attribute, mask, how.logarithmic, [&](double number) {
    if (!range) range.emplace(number, number);
    range->first = std::min(range->first, number);
    range->second = std::max(range->second, number);
  });
  return range;
}

// As far above the middle as below.
std::pair<double, double> around(double middle, std::pair<double, double> range, bool logarithmic) {
  if (logarithmic) {
    const double factor = std::max({1.0, middle / range.first, range.second / middle});
    return {middle / factor, middle * factor};
  }
  const double half = std::max({0.0, middle - range.first, range.second - middle});
  return {middle - half, middle + half};
}

Result<ColourBy> colour_by_number(const SphereSet& spheres, const ColourBy& how, const FoundAttribute& attribute,
                                  const std::vector<std::uint8_t>& mask, Transfer transfer,
                                  std::vector<Vec3f>& colours) {
  if (how.range && !(how.range->first < how.range->second))
    return colour_by_error("the range of a colour map begins below its end");
  if (how.logarithmic && how.range && !(how.range->first > 0))
    return colour_by_error("a logarithmic range begins above 0");
  const Result<Vec3f> unknown = linear_colour(how.nan_colour, transfer);
  if (!unknown) return unknown.error();
  ColourBy done = how;
  done.map = how.map.value_or(ColourMap());
  if (!done.range) done.range = range_of(spheres, how, attribute, mask).value_or(std::pair{0.0, 1.0});
  if (how.middle) done.range = around(*how.middle, *done.range, how.logarithmic);
  const Scale scale(*done.range, how.logarithmic);
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    if (mask[i] == 0) continue;
    const double share = scale.share(attribute.number_of(spheres, id));
    colours[i] = std::isnan(share) ? *unknown : map_colour(*done.map, share, transfer);
  }
  return done;
}

// The colour of the category that a number stands for, if it stands for one.
std::optional<Vec3f> number_category_colour(double number, Transfer transfer) {
  constexpr double kMostCategories = 1 << 30;
  if (!(std::abs(number) < kMostCategories)) return std::nullopt;
  return as_seen(type_colour(static_cast<std::int32_t>(std::floor(number))), transfer);
}

Vec3f colour_of_element(const std::vector<Vec3f>& colours, int element) {
  const auto i = static_cast<std::size_t>(element);
  return i < colours.size() ? colours[i] : element_colour(element);
}

// A colour for each category: texts in their order of appearance, whole numbers as they are.
Result<ColourBy> colour_by_category(const SphereSet& spheres, const ColourBy& how, const FoundAttribute& attribute,
                                    const std::vector<std::uint8_t>& mask, Transfer transfer,
                                    std::vector<Vec3f>& colours, const std::vector<Vec3f>& element_colours) {
  const Result<Vec3f> unknown = linear_colour(how.nan_colour, transfer);
  if (!unknown) return unknown.error();
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (mask[i] == 0) continue;
    const double number = attribute.has_numbers() ? attribute.number_of(spheres, static_cast<std::int64_t>(i))
                                                  : 1.0 + attribute.texts->text_of_sphere[i];
    if (attribute.is_element() && !how.map)
      colours[i] = as_seen(colour_of_element(element_colours, static_cast<int>(number)), transfer);
    else
      colours[i] = number_category_colour(number, transfer).value_or(*unknown);
  }
  ColourBy done = how;
  done.range.reset();
  return done;
}

}  // namespace

Vec3f colour_of_number(const ColourBy& done, double number, Transfer transfer) {
  // The colour of unknown numbers was understood before.
  const auto unknown = [&] { return linear_colour(done.nan_colour, transfer).value(); };
  if (!done.range) return number_category_colour(number, transfer).value_or(unknown());
  const double share = Scale(*done.range, done.logarithmic).share(number);
  return std::isnan(share) ? unknown() : map_colour(done.map.value_or(ColourMap()), share, transfer);
}

double place_in_range(std::pair<double, double> range, bool logarithmic, double number) {
  return Scale(range, logarithmic).share(number);
}

Result<Vec3f> linear_colour(const ColourChoice& colour, Transfer transfer) {
  if (const Vec3d* const linear = std::get_if<Vec3d>(&colour)) return to_float(*linear);
  const std::string& text = std::get<std::string>(colour);
  if (const auto known = colour_from_text(text, transfer)) return to_float(*known);
  return colour_by_error("expected a colour, found \"" + text + "\"",
                         "colours are #rrggbb or one of " + std::string(kColourNames));
}

std::string colour_map_file(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view part = text.substr(colon + 1, text.find(':', colon + 1) - colon - 1);
  const bool is_other = part.find(',') != std::string_view::npos || part.starts_with("mid=") || colour_map_from(part);
  return is_other || part.find_first_of("./") == std::string_view::npos ? std::string() : std::string(part);
}

std::string with_map(std::string_view text, const std::vector<std::uint32_t>& colours) {
  const std::size_t begin = text.find(':') + 1, end = std::min(text.find(':', begin), text.size());
  return std::string(text.substr(0, begin)) + text_of_colours(colours) + std::string(text.substr(end));
}

Result<ColourBy> colour_by_from_text(const std::string& text) {
  std::string rest = text;
  ColourBy how;
  how.attribute = take_part(rest);
  if (how.attribute.empty()) return colour_by_error("expected the name of an attribute, found \"" + text + "\"");
  for (bool first = true; !rest.empty(); first = false) {
    const std::string part = take_part(rest);
    const bool has_range = how.range || how.percentiles;
    if (part.empty()) continue;
    if (part == "log" && !how.logarithmic) {
      how.logarithmic = true;
    } else if (part.starts_with("mid=") && !how.middle) {
      how.middle = parse_double(std::string_view(part).substr(4));
      if (!how.middle || !std::isfinite(*how.middle))
        return colour_by_error("expected a number after mid=, found \"" + part + "\"");
    } else if (part.find(',') != std::string::npos && !has_range) {
      if (!take_range(part, how))
        return colour_by_error("expected a range MIN,MAX of two finite numbers or percentiles (2%,98%), found \"" +
                               part + "\"");
    } else if (first) {
      how.map = colour_map_from(part);
      if (!how.map) {
        const std::vector<std::string> names = colour_map_names();
        return colour_by_error("there is no colour map \"" + part + "\"",
                               suggestion(part, names) +
                                   ", each but okabe-ito also with _r; or colours such as blue-white-red, or a file");
      }
    } else {
      return colour_by_error("expected a range MIN,MAX, \"log\" or \"mid=NUMBER\", each once, found \"" + part + "\"");
    }
  }
  if (how.logarithmic && how.middle && !(*how.middle > 0))
    return colour_by_error("the middle of a logarithmic range is above 0, found \"" + text + "\"");
  if (how.map && *how.map == ColourMap::okabe_ito && (how.range || how.percentiles || how.middle || how.logarithmic))
    return colour_by_error("okabe-ito is for categories, which have no range", "leave the range out, or take viridis");
  if (how.logarithmic && how.range && !(how.range->first > 0))
    return colour_by_error("a logarithmic range begins above 0, found \"" + text + "\"");
  return how;
}

std::optional<std::pair<double, double>> number_range(const SphereSet& spheres, const ColourBy& how) {
  const Result<FoundAttribute> attribute = find_numbers(spheres, how.attribute);
  if (!attribute || attribute->texts != nullptr) return std::nullopt;
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(spheres.size()), 1);
  return range_of(spheres, how, *attribute, all);
}

Result<ColourBy> colour_by(const SphereSet& spheres, const ColourBy& how, const std::vector<std::uint8_t>& mask,
                           Transfer transfer, std::vector<Vec3f>& colours, const std::vector<Vec3f>& element_colours) {
  BIHIVE_CHECK_EQ(mask.size(), colours.size());
  const Result<FoundAttribute> found = find_numbers(spheres, how.attribute);
  if (!found) return found.error();
  const FoundAttribute& attribute = *found;
  const bool by_number = attribute.has_numbers();
  const bool of_categories = !by_number || attribute.is_element() || attribute.number == FoundAttribute::Number::type;
  const bool categorical = how.map ? *how.map == ColourMap::okabe_ito
                                   : of_categories && !how.range && !how.percentiles && !how.middle && !how.logarithmic;
  if (!categorical && !by_number)
    return colour_by_error("\"" + how.attribute + "\" holds texts, and this map needs numbers",
                           "leave the map out, or take okabe-ito");
  return categorical ? colour_by_category(spheres, how, attribute, mask, transfer, colours, element_colours)
                     : colour_by_number(spheres, how, attribute, mask, transfer, colours);
}

}  // namespace bihive
