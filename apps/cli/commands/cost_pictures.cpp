#include "commands/cost_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "bihive/image/image.h"
#include "bihive/image/png.h"
#include "bihive/job/failure.h"
#include "bihive/scene/colour_maps.h"

namespace bihive::cli {
namespace {

constexpr int kColoursOfScale = 9;

struct Rgb {
  std::uint8_t red, green, blue;
};

Rgb colour_at(double share) {
  const Vec3f colour = map_colour(ColourMap::viridis, share, Transfer::none);
  const auto byte = [](float value) { return byte_from_radiance(double(value), Transfer::none); };
  return {byte(colour.x), byte(colour.y), byte(colour.z)};
}

}  // namespace

double CostPictures::share(double steps) const {
  return end > 1 ? std::clamp(std::log(std::max(steps, 1.0)) / std::log(end), 0.0, 1.0) : 0;
}

CostPictures cost_pictures(const workbench::Comparison& comparison) {
  CostPictures made;
  for (const workbench::StructureResult& one : comparison.structures)
    for (const float cost : one.costs) made.end = std::max(made.end, double(cost));
  for (double tick = 1; tick <= made.end; tick *= 10) made.ticks.push_back(tick);
  for (int i = 0; i < kColoursOfScale; ++i) {
    const Rgb colour = colour_at(i / double(kColoursOfScale - 1));
    made.colours.push_back(fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue));
  }
  for (const workbench::StructureResult& one : comparison.structures) {
    if (one.costs.empty()) continue;
    CostPicture picture;
    picture.structure = one.row.name;
    const auto [least, most] = std::minmax_element(one.costs.begin(), one.costs.end());
    picture.least = double(*least);
    picture.most = double(*most);
    picture.mean = std::accumulate(one.costs.begin(), one.costs.end(), 0.0) / static_cast<double>(one.costs.size());
    Image image;
    image.width = image.height = static_cast<int>(std::lround(std::sqrt(static_cast<double>(one.costs.size()))));
    for (const float cost : one.costs) {
      const Rgb colour = colour_at(made.share(double(cost)));
      image.rgb.insert(image.rgb.end(), {colour.red, colour.green, colour.blue});
    }
    picture.png = value_or_fail(encode_png(image, {}));
    made.pictures.push_back(std::move(picture));
  }
  return made;
}

}  // namespace bihive::cli
