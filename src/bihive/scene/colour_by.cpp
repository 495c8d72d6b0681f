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

std::optional<std::pair<double, double>> range_from(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const auto low = parse_double(std::string_view(text).substr(0, comma));
  const auto high = parse_double(std::string_view(text).substr(comma + 1));
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || !(*low < *high)) return std::nullopt;
  return std::pair{*low, *high};
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
    if (std::isnan(place)) return place;
    if (!(low_ < high_)) return 0.5;
    // Halves, so that no difference overflows.
    return (place / 2 - low_ / 2) / (high_ / 2 - low_ / 2);
  }

 private:
  double along(double number) const {
    if (!logarithmic_) return number;
    if (!(number > 0)) return std::numeric_limits<double>::quiet_NaN();
    return std::isfinite(number) ? portable_log2(number) : number;
  }

  bool logarithmic_;
  double low_, high_;
};

// The smallest and largest finite number of the spheres in the mask; with a logarithmic scale above 0.
std::optional<std::pair<double, double>> range_of(const SphereSet& spheres, const FoundAttribute& attribute,
                                                  const std::vector<std::uint8_t>& mask, bool logarithmic) {
  std::optional<std::pair<double, double>> range;
  const auto add = [&](std::int64_t id, double number) {
    if (mask[static_cast<std::size_t>(spheres.stored_id(id))] == 0) return;
    if (!std::isfinite(number) || (logarithmic && !(number > 0))) return;
    if (!range) range.emplace(number, number);
    range->first = std::min(range->first, number);
    range->second = std::max(range->second, number);
  };
  // Images differ from their stored sphere in place and index alone.
  using Number = FoundAttribute::Number;
  const bool by_place = attribute.number == Number::x || attribute.number == Number::y || attribute.number == Number::z;
  if (spheres.has_images() && (by_place || attribute.number == Number::index)) {
    const int axis = attribute.number == Number::x ? 0 : attribute.number == Number::y ? 1 : 2;
    for_each_sphere(spheres, [&](std::int64_t id, Vec3d centre, double) {
      add(id, by_place ? centre[axis] : static_cast<double>(id));
    });
  } else {
    for (std::int64_t id = 0; id < spheres.size(); ++id) add(id, attribute.number_of(spheres, id));
  }
  return range;
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
  done.map = how.map.value_or(ColourMap::viridis);
  if (!done.range) done.range = range_of(spheres, attribute, mask, how.logarithmic).value_or(std::pair{0.0, 1.0});
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

// A colour for each category: texts in their order of appearance, whole numbers as they are.
Result<ColourBy> colour_by_category(const SphereSet& spheres, const ColourBy& how, const FoundAttribute& attribute,
                                    const std::vector<std::uint8_t>& mask, Transfer transfer,
                                    std::vector<Vec3f>& colours) {
  const Result<Vec3f> unknown = linear_colour(how.nan_colour, transfer);
  if (!unknown) return unknown.error();
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (mask[i] == 0) continue;
    const double number = attribute.has_numbers() ? attribute.number_of(spheres, static_cast<std::int64_t>(i))
                                                  : 1.0 + attribute.texts->text_of_sphere[i];
    if (attribute.is_element() && !how.map)
      colours[i] = as_seen(element_colour(static_cast<int>(number)), transfer);
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
  return std::isnan(share) ? unknown() : map_colour(done.map.value_or(ColourMap::viridis), share, transfer);
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

Result<ColourBy> colour_by_from_text(const std::string& text) {
  std::string rest = text;
  ColourBy how;
  how.attribute = take_part(rest);
  if (how.attribute.empty()) return colour_by_error("expected the name of an attribute, found \"" + text + "\"");
  if (const std::string map = take_part(rest); !map.empty()) {
    how.map = colour_map_from(map);
    if (!how.map)
      return colour_by_error("there is no colour map \"" + map + "\"", "there are " + std::string(kColourMapNames));
  }
  if (const std::string range = take_part(rest); range == "log" && rest.empty()) {
    how.logarithmic = true;
  } else if (!range.empty()) {
    how.range = range_from(range);
    if (!how.range)
      return colour_by_error("expected a range MIN,MAX of finite numbers with MIN below MAX, found \"" + range + "\"");
  }
  if (rest == "log") how.logarithmic = true;
  if (!rest.empty() && rest != "log") return colour_by_error("expected \"log\" at the end, found \"" + rest + "\"");
  if (how.logarithmic && how.range && !(how.range->first > 0))
    return colour_by_error("a logarithmic range begins above 0, found \"" + text + "\"");
  return how;
}

std::optional<std::pair<double, double>> number_range(const SphereSet& spheres, const ColourBy& how) {
  const FoundAttribute attribute = find_attribute(spheres, how.attribute);
  if (!attribute.found() || attribute.texts != nullptr) return std::nullopt;
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(spheres.size()), 1);
  return range_of(spheres, attribute, all, how.logarithmic);
}

Result<ColourBy> colour_by(const SphereSet& spheres, const ColourBy& how, const std::vector<std::uint8_t>& mask,
                           Transfer transfer, std::vector<Vec3f>& colours) {
  BIHIVE_CHECK_EQ(mask.size(), colours.size());
  const FoundAttribute attribute = find_attribute(spheres, how.attribute);
  if (!attribute.found())
    return colour_by_error("there is no attribute \"" + how.attribute + "\"",
                           suggestion(how.attribute, attribute_names(spheres)));
  const bool by_number = attribute.has_numbers();
  const bool of_categories = !by_number || attribute.is_element() || attribute.number == FoundAttribute::Number::type;
  const bool categorical = how.map ? *how.map == ColourMap::okabe_ito : of_categories && !how.range && !how.logarithmic;
  if (!categorical && !by_number)
    return colour_by_error("\"" + how.attribute + "\" holds texts, and this map needs numbers",
                           "leave the map out, or take okabe-ito");
  return categorical ? colour_by_category(spheres, how, attribute, mask, transfer, colours)
                     : colour_by_number(spheres, how, attribute, mask, transfer, colours);
}

}  // namespace bihive
