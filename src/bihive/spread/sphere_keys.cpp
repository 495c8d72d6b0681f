#include "bihive/spread/sphere_keys.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "bihive/math/spread_bits.h"

namespace bihive {
namespace {

constexpr int kBits = 21;  // of each axis

std::uint64_t cell_along(float place) {
  constexpr double kCells = std::uint64_t{1} << kBits;
  const double cell = (double(place) + 1) * (0.5 * kCells);
  return static_cast<std::uint64_t>(std::clamp(cell, 0.0, kCells - 1));
}

// Bits that ascend with the number. -0 and 0 are equal.
std::uint32_t ordered_bits(float number) {
  number += 0.0F;
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

}  // namespace

SphereKey key_of(float x, float y, float z) {
  return {spread_bits(cell_along(x)) | spread_bits(cell_along(y)) << 1 | spread_bits(cell_along(z)) << 2,
          ordered_bits(x), ordered_bits(y), ordered_bits(z)};
}

SphereKey key_of(const SphereSet& spheres, std::int64_t id) {
  const auto i = static_cast<std::size_t>(id);
  return key_of(spheres.x()[i], spheres.y()[i], spheres.z()[i]);
}

std::vector<SphereKey> starts_of_ranks(std::vector<SphereKey> samples, int ranks) {
  std::sort(samples.begin(), samples.end());
  std::vector<SphereKey> starts;
  for (int rank = 1; rank < ranks; ++rank) {
    const std::size_t at = samples.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks);
    starts.push_back(samples.empty() ? SphereKey{} : samples[at]);
  }
  return starts;
}

int rank_of(const SphereKey& key, const std::vector<SphereKey>& starts) {
  return static_cast<int>(std::upper_bound(starts.begin(), starts.end(), key) - starts.begin());
}

}  // namespace bihive
