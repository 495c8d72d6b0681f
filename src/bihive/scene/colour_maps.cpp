#include "bihive/scene/colour_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bihive {
namespace {

constexpr int kControls = 33;

// Control colours at equal distances, as they appear on the screen. Those of viridis, magma and cividis are their
// authors' tables of 256 colours at every eighth place, rounded to bytes. Those of coolwarm come from its author's
// formula, from (59, 76, 192) by (221, 221, 221) to (180, 4, 38).
constexpr std::uint32_t kViridis[kControls] = {
    0x440154, 0x470D60, 0x48186A, 0x482374, 0x472D7B, 0x453681, 0x424086, 0x3F4989, 0x3B528B, 0x375A8D, 0x33638D,
    0x2F6A8E, 0x2C728E, 0x297A8E, 0x26818E, 0x23898E, 0x21908C, 0x1F988B, 0x1F9F88, 0x21A685, 0x28AE80, 0x31B57B,
    0x3EBC74, 0x4CC26C, 0x5DC963, 0x6ECE58, 0x82D34C, 0x96D83F, 0xABDC32, 0xC0DF24, 0xD5E21A, 0xEAE51A, 0xFDE725};
constexpr std::uint32_t kMagma[kControls] = {
    0x000004, 0x030311, 0x0A0822, 0x130D33, 0x1D1146, 0x28115A, 0x36106A, 0x430F76, 0x50127C, 0x5D177F, 0x691C81,
    0x762181, 0x822681, 0x8F2A81, 0x9C2E7F, 0xA9327D, 0xB63779, 0xC33B75, 0xCF4170, 0xDB486A, 0xE65163, 0xEE5C5E,
    0xF5695C, 0xF9785D, 0xFB8761, 0xFD9668, 0xFEA571, 0xFEB47B, 0xFEC387, 0xFED194, 0xFDE0A2, 0xFCEEB0, 0xFCFDBF};
constexpr std::uint32_t kCividis[kControls] = {
    0x00204D, 0x00265A, 0x002C68, 0x00306F, 0x05366E, 0x1E3C6D, 0x2C426C, 0x37476B, 0x414D6B, 0x4A536B, 0x52596C,
    0x595E6D, 0x61646F, 0x686A71, 0x6F7073, 0x757676, 0x7C7B78, 0x848279, 0x8C8879, 0x948E78, 0x9C9477, 0xA49B76,
    0xACA174, 0xB4A872, 0xBDAF6F, 0xC5B66C, 0xCEBD68, 0xD7C463, 0xE0CB5E, 0xE9D358, 0xF2DA50, 0xFBE248, 0xFFEA46};
constexpr std::uint32_t kCoolwarm[kControls] = {
    0x3B4CC0, 0x445ACC, 0x4E68D7, 0x5875E1, 0x6282EA, 0x6C8EF1, 0x779AF7, 0x82A5FB, 0x8DB0FE, 0x98B9FF, 0xA3C2FE,
    0xAEC9FD, 0xB8D0F9, 0xC2D5F4, 0xCCD9EE, 0xD5DBE6, 0xDDDDDD, 0xE5D8D1, 0xECD3C6, 0xF1CCB9, 0xF5C4AD, 0xF7BBA0,
    0xF7B194, 0xF7A687, 0xF49A7B, 0xF18D6F, 0xEC7F63, 0xE57057, 0xDE614C, 0xD55042, 0xCB3E38, 0xC0282F, 0xB40426};

const std::uint32_t (&controls_of(ColourMap map))[kControls] {
  switch (map) {
    case ColourMap::magma:
      return kMagma;
    case ColourMap::cividis:
      return kCividis;
    case ColourMap::coolwarm:
      return kCoolwarm;
    case ColourMap::viridis:
    case ColourMap::okabe_ito:
      break;
  }
  return kViridis;
}

double channel_of(std::uint32_t rgb, int channel) {
  return ((rgb >> (16 - 8 * channel)) & 0xFF) / 255.0;
}

}  // namespace

std::optional<ColourMap> colour_map_from(std::string_view name) {
  if (name == "viridis") return ColourMap::viridis;
  if (name == "magma") return ColourMap::magma;
  if (name == "cividis") return ColourMap::cividis;
  if (name == "coolwarm") return ColourMap::coolwarm;
  if (name == "okabe-ito") return ColourMap::okabe_ito;
  return std::nullopt;
}

Vec3f map_colour(ColourMap map, double share, Transfer transfer) {
  const std::uint32_t(&controls)[kControls] = controls_of(map);
  const double place = std::clamp(share, 0.0, 1.0) * (kControls - 1);
  const int below = std::min(static_cast<int>(place), kControls - 2);
  const double weight = place - below;
  Vec3f colour;
  for (int channel = 0; channel < 3; ++channel) {
    const double screen =
        (1 - weight) * channel_of(controls[below], channel) + weight * channel_of(controls[below + 1], channel);
    colour[channel] = static_cast<float>(transfer == Transfer::srgb ? linear_from_srgb(screen) : screen);
  }
  return colour;
}

}  // namespace bihive
