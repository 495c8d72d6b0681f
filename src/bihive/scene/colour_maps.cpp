#include "bihive/scene/colour_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/image/colour_text.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr int kControls = 33;

// Control colours at equal distances, as they appear on the screen. Those of viridis, magma and cividis are their
// authors' tables of 256 colours at every eighth place, rounded to bytes. Those of coolwarm come from its author's
// formula, from (59, 76, 192) by (221, 221, 221) to (180, 4, 38). plasma, inferno and turbo are tables of 256 colours
// too; RdBu passes through ColorBrewer's eleven colours.
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

constexpr std::uint32_t kPlasma[kControls] = {
    0x0D0887, 0x220690, 0x310597, 0x3F049C, 0x4C02A1, 0x5901A5, 0x6600A7, 0x7201A8, 0x7E03A8, 0x8A09A5, 0x9511A1,
    0xA01A9C, 0xAA2395, 0xB32C8E, 0xBC3587, 0xC43E7F, 0xCC4778, 0xD35171, 0xDA5A6A, 0xE06363, 0xE66C5C, 0xEB7655,
    0xF0804E, 0xF58B47, 0xF89540, 0xFBA139, 0xFDAC33, 0xFEB82C, 0xFDC527, 0xFCD225, 0xF8DF25, 0xF4ED27, 0xF0F921};
constexpr std::uint32_t kInferno[kControls] = {
    0x000004, 0x040312, 0x0B0724, 0x150B37, 0x210C4A, 0x2F0A5B, 0x3D0965, 0x4A0C6B, 0x57106E, 0x64156E, 0x71196E,
    0x7D1E6D, 0x8A226A, 0x972766, 0xA32C61, 0xB0315B, 0xBC3754, 0xC73E4C, 0xD24644, 0xDB503B, 0xE45A31, 0xEB6628,
    0xF1731D, 0xF68013, 0xF98E09, 0xFB9D07, 0xFCAC11, 0xFBBC21, 0xF9CB35, 0xF5DB4C, 0xF2EA69, 0xF3F68A, 0xFCFFA4};
constexpr std::uint32_t kTurbo[kControls] = {
    0x30123B, 0x392A73, 0x4040A2, 0x4456C7, 0x466BE3, 0x4680F6, 0x4294FF, 0x37A8FA, 0x28BCEB, 0x1CCDD8, 0x18DDC2,
    0x1FE9AF, 0x32F298, 0x4EF97D, 0x6DFE62, 0x8BFF4B, 0xA4FC3C, 0xB9F635, 0xCDEC34, 0xDFDF37, 0xEECF3A, 0xF8BE39,
    0xFDAC34, 0xFE962B, 0xFB7E21, 0xF46617, 0xEB500E, 0xDF3F08, 0xD02F05, 0xBE2102, 0xA91601, 0x920B01, 0x7A0403};
constexpr std::uint32_t kRdBu[kControls] = {
    0x67001F, 0x7F0823, 0x960F27, 0xAE172A, 0xBB2A34, 0xC6413E, 0xD25849, 0xDC6E57, 0xE58368, 0xEF9979, 0xF5AC8B,
    0xF8BDA1, 0xFBCEB7, 0xFDDDCB, 0xFBE6DA, 0xF9EFE9, 0xF6F7F7, 0xEAF1F5, 0xDEEBF2, 0xD2E6F0, 0xC0DCEB, 0xACD2E5,
    0x98C8E0, 0x81BAD8, 0x68ABD0, 0x4F9BC7, 0x3E8CBF, 0x337EB8, 0x2870B1, 0x1E61A5, 0x15508D, 0x0D3F76, 0x053061};
constexpr std::uint32_t kGreys[kControls] = {
    0x000000, 0x080808, 0x101010, 0x181818, 0x202020, 0x282828, 0x303030, 0x383838, 0x404040, 0x484848, 0x505050,
    0x585858, 0x606060, 0x686868, 0x707070, 0x787878, 0x808080, 0x878787, 0x8F8F8F, 0x979797, 0x9F9F9F, 0xA7A7A7,
    0xAFAFAF, 0xB7B7B7, 0xBFBFBF, 0xC7C7C7, 0xCFCFCF, 0xD7D7D7, 0xDFDFDF, 0xE7E7E7, 0xEFEFEF, 0xF7F7F7, 0xFFFFFF};

// One map: its name, and its control colours; null: of categories.
struct MapRow {
  std::string_view name;
  ColourMap::Name map;
  const std::uint32_t* controls;
};
constexpr MapRow kMaps[] = {{"viridis", ColourMap::viridis, kViridis}, {"magma", ColourMap::magma, kMagma},
                            {"plasma", ColourMap::plasma, kPlasma},    {"inferno", ColourMap::inferno, kInferno},
                            {"cividis", ColourMap::cividis, kCividis}, {"turbo", ColourMap::turbo, kTurbo},
                            {"greys", ColourMap::greys, kGreys},       {"coolwarm", ColourMap::coolwarm, kCoolwarm},
                            {"RdBu", ColourMap::rd_bu, kRdBu},         {"okabe-ito", ColourMap::okabe_ito, nullptr}};

// The control colours of a map, at equal distances.
struct Controls {
  const std::uint32_t* first;
  int count;
};

Controls controls_of(const ColourMap& map) {
  if (map.name == ColourMap::own && map.colours.size() >= 2)
    return {map.colours.data(), static_cast<int>(map.colours.size())};
  for (const MapRow& row : kMaps)
    if (row.map == map.name && row.controls != nullptr) return {row.controls, kControls};
  return {kViridis, kControls};
}

std::uint32_t bytes_of(Vec3d screen) {
  std::uint32_t rgb = 0;
  for (int channel = 0; channel < 3; ++channel)
    rgb = rgb << 8 | static_cast<std::uint32_t>(std::lround(std::clamp(screen[channel], 0.0, 1.0) * 255));
  return rgb;
}

double channel_of(std::uint32_t rgb, int channel) {
  return ((rgb >> (16 - 8 * channel)) & 0xFF) / 255.0;
}

}  // namespace

std::vector<std::string> colour_map_names() {
  std::vector<std::string> names;
  for (const MapRow& row : kMaps) names.emplace_back(row.name);
  return names;
}

std::string text_of_colours(const std::vector<std::uint32_t>& colours) {
  std::string text;
  for (const std::uint32_t rgb : colours) {
    char one[8];
    std::snprintf(one, sizeof one, "#%06x", static_cast<unsigned>(rgb & 0xFFFFFF));
    text += (text.empty() ? "" : "-") + std::string(one);
  }
  return text;
}

ColourMap reversed(ColourMap map) {
  map.is_reversed = !map.is_reversed;
  return map;
}

std::optional<ColourMap> colour_map_from(std::string_view name) {
  const bool backwards = name.ends_with("_r");
  const std::string_view forward = backwards ? name.substr(0, name.size() - 2) : name;
  for (const MapRow& row : kMaps)
    if (row.name == forward && !(backwards && row.controls == nullptr))
      return backwards ? reversed(row.map) : ColourMap(row.map);
  ColourMap own(ColourMap::own);
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('-', begin), name.size());
    const auto colour = colour_from_text(name.substr(begin, end - begin), Transfer::none);
    if (!colour || own.colours.size() == kMostMapColours) return std::nullopt;
    own.colours.push_back(bytes_of(*colour));
    begin = end + 1;
  }
  if (own.colours.size() < 2) return std::nullopt;
  return own;
}

Result<std::vector<std::uint32_t>> read_colour_map(std::string_view text, const std::string& file) {
  constexpr const char* kForm = "a line is #rrggbb, a colour's name, or three numbers from 0 to 1 or to 255";
  std::vector<std::uint32_t> colours;
  std::vector<std::pair<std::size_t, Vec3d>> of_numbers;  // and where among the colours
  double largest = 0;
  TextScanner scanner(text, file);
  while (scanner.next_filled_line()) {
    std::string line(trim(scanner.line()));
    const auto named = colour_from_text(line, Transfer::none);
    if (!named && line.front() == '#') continue;
    if (colours.size() == kMostMapColours)
      return scanner.line_error("a colour map has at most " + std::to_string(kMostMapColours) + " colours");
    colours.push_back(named ? bytes_of(*named) : 0);
    if (named) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    TextScanner fields(line, "");
    fields.next_line();
    Vec3d rgb;
    std::string_view field;
    for (int channel = 0; channel < 3; ++channel) {
      const auto number = fields.next_field(field) ? parse_double(field) : std::nullopt;
      if (!number || !(*number >= 0 && *number <= 255))
        return scanner.line_error("expected a colour but found " + quote(trim(scanner.line())), kForm);
      rgb[channel] = *number;
      largest = std::max(largest, *number);
    }
    if (fields.next_field(field))
      return scanner.line_error("expected a colour but found " + quote(trim(scanner.line())), kForm);
    of_numbers.emplace_back(colours.size() - 1, rgb);
  }
  if (colours.size() < 2) return Error{"a colour map has at least two colours, each on a line", file, 0, 0, kForm};
  for (const auto& [at, rgb] : of_numbers) colours[at] = bytes_of(largest > 1 ? rgb / 255 : rgb);
  return colours;
}

Vec3f map_colour(const ColourMap& map, double share, Transfer transfer) {
  const auto [controls, count] = controls_of(map);
  if (map.is_reversed) share = 1 - share;
  const double place = std::clamp(share, 0.0, 1.0) * (count - 1);
  const int below = std::min(static_cast<int>(place), count - 2);
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
