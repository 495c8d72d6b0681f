#include "bihive/image/colour_text.h"

#include <cstdint>
#include <string>

#include "bihive/base/ascii.h"
#include "bihive/base/parse_number.h"
#include "bihive/math/vector_text.h"

namespace bihive {
namespace {

struct NamedColour {
  std::string_view name;
  std::uint32_t rgb;
};

// The primaries and their mixtures at full strength, and some other colours of the web [CSSColor4].
constexpr NamedColour kNamedColours[] = {
    {"white", 0xFFFFFF},  {"black", 0x000000},  {"grey", 0x808080}, {"red", 0xFF0000},     {"green", 0x00FF00},
    {"blue", 0x0000FF},   {"yellow", 0xFFFF00}, {"cyan", 0x00FFFF}, {"magenta", 0xFF00FF}, {"orange", 0xFFA500},
    {"purple", 0x800080}, {"brown", 0xA52A2A},  {"pink", 0xFFC0CB},
};

std::optional<std::uint32_t> bytes_from_text(std::string_view text) {
  for (const NamedColour& named : kNamedColours)
    if (named.name == text) return named.rgb;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  for (const char c : text.substr(1)) {
    const int digit = hex_value(c);
    if (digit < 0) return std::nullopt;
    rgb = rgb * 16 + static_cast<std::uint32_t>(digit);
  }
  return rgb;
}

// "srgb(0.5,0.25,1)".
std::optional<Vec3d> srgb_from_text(std::string_view text) {
  constexpr std::string_view kBegin = "srgb(";
  if (!text.starts_with(kBegin) || !text.ends_with(')')) return std::nullopt;
  return vector_from_text(text.substr(kBegin.size(), text.size() - kBegin.size() - 1), 0, 1);
}

// As the screen shows them.
std::optional<Vec3d> screen_from_text(std::string_view text) {
  const std::optional<std::uint32_t> rgb = bytes_from_text(text);
  if (!rgb) return srgb_from_text(text);
  const auto channel = [&rgb](int shift) { return ((*rgb >> shift) & 0xFF) / 255.0; };
  return Vec3d{channel(16), channel(8), channel(0)};
}

}  // namespace

std::optional<Vec3d> colour_from_text(std::string_view text, Transfer transfer) {
  std::optional<Vec3d> colour = screen_from_text(text);
  if (colour && transfer == Transfer::srgb)
    for (int channel = 0; channel < 3; ++channel) (*colour)[channel] = linear_from_srgb((*colour)[channel]);
  return colour;
}

}  // namespace bihive
