#include "bihive/scene/palette.h"

#include <array>
#include <iterator>

#include "bihive/image/transfer.h"

namespace bihive {
namespace {

// The element colours of Jmol, by atomic number, as sRGB [Jmol]: a wider version of the CPK colours. 0 = unknown.
constexpr std::uint32_t kElementColours[] = {
    0xFF1493,  // unknown
    // H ... Ne
    0xFFFFFF, 0xD9FFFF, 0xCC80FF, 0xC2FF00, 0xFFB5B5, 0x909090, 0x3050F8, 0xFF0D0D, 0x90E050, 0xB3E3F5,
    // Na ... Ar
    0xAB5CF2, 0x8AFF00, 0xBFA6A6, 0xF0C8A0, 0xFF8000, 0xFFFF30, 0x1FF01F, 0x80D1E3,
    // K ... Kr
    0x8F40D4, 0x3DFF00, 0xE6E6E6, 0xBFC2C7, 0xA6A6AB, 0x8A99C7, 0x9C7AC7, 0xE06633, 0xF090A0, 0x50D050, 0xC88033,
    0x7D80B0, 0xC28F8F, 0x668F8F, 0xBD80E3, 0xFFA100, 0xA62929, 0x5CB8D1,
    // Rb ... Xe
    0x702EB0, 0x00FF00, 0x94FFFF, 0x94E0E0, 0x73C2C9, 0x54B5B5, 0x3B9E9E, 0x248F8F, 0x0A7D8C, 0x006985, 0xC0C0C0,
    0xFFD98F, 0xA67573, 0x668080, 0x9E63B5, 0xD47A00, 0x940094, 0x429EB0,
    // Cs, Ba, La ... Lu
    0x57178F, 0x00C900, 0x70D4FF, 0xFFFFC7, 0xD9FFC7, 0xC7FFC7, 0xA3FFC7, 0x8FFFC7, 0x61FFC7, 0x45FFC7, 0x30FFC7,
    0x1FFFC7, 0x00FF9C, 0x00E675, 0x00D452, 0x00BF38, 0x00AB24,
    // Hf ... Rn
    0x4DC2FF, 0x4DA6FF, 0x2194D6, 0x267DAB, 0x266696, 0x175487, 0xD0D0E0, 0xFFD123, 0xB8B8D0, 0xA6544D, 0x575961,
    0x9E4FB5, 0xAB5C00, 0x754F45, 0x428296,
    // Fr, Ra, Ac ... Lr
    0x420066, 0x007D00, 0x70ABFA, 0x00BAFF, 0x00A1FF, 0x008FFF, 0x0080FF, 0x006BFF, 0x545CF2, 0x785CE3, 0x8A4FE3,
    0xA136D4, 0xB31FD4, 0xB31FBA, 0xB30DA6, 0xBD0D87, 0xC70066,
    // Rf ... Mt
    0xCC0059, 0xD1004F, 0xD90045, 0xE00038, 0xE6002E, 0xEB0026};
constexpr int kElements = 110;
static_assert(std::size(kElementColours) == kElements);

// Eight colours that colour-blind people can tell apart, as sRGB [OkabeIto2008], for the types 1 to 8. Its black is
// replaced by a grey, because a black sphere shows no shading.
constexpr std::uint32_t kTypeColours[] = {0xE69F00, 0x56B4E9, 0x009E73, 0xF0E442,
                                          0x0072B2, 0xD55E00, 0xCC79A7, 0x999999};
constexpr int kTypes = 8;
static_assert(std::size(kTypeColours) == kTypes);

// Further types have the same colours mixed with white or black.
struct Mixed {
  float share, white;
};
constexpr Mixed kMixed[] = {{0.5f, 1}, {0.6f, 0}, {0.75f, 1}, {0.85f, 0}};

template <std::size_t n>
std::array<Vec3f, n> linear_colours(const std::uint32_t (&srgb)[n]) {
  std::array<Vec3f, n> linear;
  for (std::size_t i = 0; i < n; ++i)
    for (int channel = 0; channel < 3; ++channel)
      linear[i][channel] = static_cast<float>(linear_from_srgb(((srgb[i] >> (16 - 8 * channel)) & 0xFF) / 255.0));
  return linear;
}

// Biological elements are matched by eye; the others are Jmol's, darker and a little greyer.
std::array<Vec3f, kElements> soft_colours(std::array<Vec3f, kElements> colours) {
  for (Vec3f& colour : colours) {
    const float luminance = 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z;  // ITU-R BT.709
    for (int channel = 0; channel < 3; ++channel)
      colour[channel] = 0.85f * (0.75f * colour[channel] + 0.25f * luminance);
  }
  colours[1] = {0.82f, 0.82f, 0.81f};   // H
  colours[6] = {0.56f, 0.56f, 0.55f};   // C
  colours[7] = {0.24f, 0.38f, 0.76f};   // N
  colours[8] = {0.80f, 0.20f, 0.17f};   // O
  colours[15] = {0.85f, 0.45f, 0.12f};  // P
  colours[16] = {0.88f, 0.72f, 0.20f};  // S
  return colours;
}

// Bright colours would be too vivid for large areas of one type.
std::array<Vec3f, kTypes> soft_types(std::array<Vec3f, kTypes> colours) {
  for (Vec3f& colour : colours) {
    const float luminance = 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z;
    for (int channel = 0; channel < 3; ++channel) colour[channel] = 0.78f * colour[channel] + 0.22f * luminance;
  }
  return colours;
}

}  // namespace

Vec3f element_colour(int atomic_number, ElementScheme scheme) {
  static const std::array<Vec3f, kElements> jmol = linear_colours(kElementColours);
  static const std::array<Vec3f, kElements> soft = soft_colours(jmol);
  const bool known = atomic_number > 0 && atomic_number < kElements;
  return (scheme == ElementScheme::jmol ? jmol : soft)[known ? static_cast<std::size_t>(atomic_number) : 0];
}

std::vector<Vec3f> element_colours_of(ElementScheme scheme) {
  std::vector<Vec3f> colours;
  for (int number = 0; number < kElementNumbers; ++number) colours.push_back(element_colour(number, scheme));
  return colours;
}

Vec3f type_colour(std::int32_t type, ElementScheme scheme) {
  static const std::array<Vec3f, kTypes> bright = linear_colours(kTypeColours);
  static const std::array<Vec3f, kTypes> soft = soft_types(bright);
  const std::array<Vec3f, kTypes>& colours = scheme == ElementScheme::jmol ? bright : soft;
  constexpr std::int64_t kColours = std::int64_t{kTypes} * (1 + std::size(kMixed));
  const std::int64_t remainder = (std::int64_t{type} - 1) % kColours;
  const std::int64_t number = remainder < 0 ? remainder + kColours : remainder;
  Vec3f colour = colours[static_cast<std::size_t>(number % kTypes)];
  if (number < kTypes) return colour;
  const Mixed mixed = kMixed[number / kTypes - 1];
  for (int channel = 0; channel < 3; ++channel)
    colour[channel] = (1 - mixed.share) * colour[channel] + mixed.share * mixed.white;
  return colour;
}

std::string_view colour_spheres(SphereSet& spheres, ElementScheme scheme) {
  SphereAttributes& attributes = spheres.attributes();
  if (!attributes.colour.empty()) return "";
  const std::size_t n = static_cast<std::size_t>(spheres.size());
  if (!attributes.element.empty()) {
    attributes.colour.resize(n);
    for (std::size_t i = 0; i < n; ++i) attributes.colour[i] = element_colour(attributes.element[i], scheme);
    return "element";
  }
  if (attributes.type.empty()) return "";
  attributes.colour.resize(n);
  for (std::size_t i = 0; i < n; ++i) attributes.colour[i] = type_colour(attributes.type[i], scheme);
  return "type";
}

}  // namespace bihive
