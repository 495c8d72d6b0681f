// The packing of XTC [XTC]. Each place is three whole numbers above the lowest, written as one number in a mixed base.
// After it may come a run of up to ten places near it, in a smaller base, as differences. A run's first place and the
// place before it are exchanged, which packs water better.
#include "bihive/io/formats/trajectories/packed_places.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace bihive {
namespace {

// Sizes of the smaller base: 2^(i / 3), rounded to what fits i bits three times. Those below the first are not used.
constexpr std::int32_t kFirstSize = 9;
// Writers state the length of the table where all neighbours lie farther apart than its last size. Then nothing is
// written in the smaller base.
constexpr std::int32_t kNoSize = 73;
constexpr std::array<std::int32_t, kNoSize> kSizes{
    0,       0,       0,       0,       0,        0,        0,       0,       0,       8,       10,
    12,      16,      20,      25,      32,       40,       50,      64,      80,      101,     128,
    161,     203,     256,     322,     406,      512,      645,     812,     1024,    1290,    1625,
    2048,    2580,    3250,    4096,    5060,     6501,     8192,    10321,   13003,   16384,   20642,
    26007,   32768,   41285,   52015,   65536,    82570,    104031,  131072,  165140,  208063,  262144,
    330280,  416127,  524287,  660561,  832255,   1048576,  1321122, 1664510, 2097152, 2642245, 3329021,
    4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216};

// A larger base has its three numbers written apart.
constexpr std::uint32_t kLargestMixedBase = 0xFFFFFF;

// The bits in which every number below `size` fits.
int bits_below(std::uint32_t size) {
  int bits = 0;
  while (bits < 32 && (std::uint64_t{1} << bits) <= size) ++bits;
  return bits;
}

// The bits of a number in the mixed base of the three sizes.
int bits_of_base(const std::uint32_t (&sizes)[3]) {
  // The product of the sizes, byte after byte from the lowest.
  std::array<std::uint32_t, 16> bytes{1};
  std::size_t used = 1;
  for (const std::uint32_t size : sizes) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < used || carry != 0; ++i) {
      carry += i < used ? std::uint64_t{bytes[i]} * size : 0;
      bytes[i] = static_cast<std::uint32_t>(carry & 0xFF);
      carry >>= 8;
      used = std::max(used, i + 1);
    }
  }
  int bits = 0;
  while ((std::uint32_t{1} << bits) <= bytes[used - 1]) ++bits;
  return bits + static_cast<int>(used - 1) * 8;
}

// Bits from the highest of each byte on.
class BitReader {
 public:
  explicit BitReader(std::string_view bytes) : bytes_(bytes) {}

  // Up to 32 bits as a number; 0, and failed(), behind the end.
  std::uint32_t take(int count) {
    while (have_ < count) {
      if (next_ == bytes_.size()) {
        failed_ = true;
        return 0;
      }
      held_ = held_ << 8 | static_cast<unsigned char>(bytes_[next_++]);
      have_ += 8;
    }
    have_ -= count;
    return static_cast<std::uint32_t>(held_ >> have_ & ((std::uint64_t{1} << count) - 1));
  }

  // Three numbers of the mixed base `sizes`. The bytes come from the lowest on; the last may have fewer bits.
  void take_three(int bits, const std::uint32_t (&sizes)[3], std::int64_t (&numbers)[3]) {
    std::array<std::uint32_t, 12> bytes{};
    std::size_t used = 0;
    for (; bits > 0; bits -= 8) bytes[used++] = take(std::min(bits, 8));
    for (int k = 2; k > 0; --k) {
      std::uint64_t rest = 0;
      for (std::size_t i = used; i-- > 0;) {
        rest = rest << 8 | bytes[i];
        bytes[i] = static_cast<std::uint32_t>(rest / sizes[k]);
        rest %= sizes[k];
      }
      numbers[k] = static_cast<std::int64_t>(rest);
    }
    numbers[0] = static_cast<std::int64_t>(std::uint64_t{bytes[0]} | std::uint64_t{bytes[1]} << 8 |
                                           std::uint64_t{bytes[2]} << 16 | std::uint64_t{bytes[3]} << 24);
  }

  bool failed() const { return failed_; }

 private:
  std::string_view bytes_;
  std::size_t next_ = 0;
  std::uint64_t held_ = 0;
  int have_ = 0;
  bool failed_ = false;
};

class Unpacker {
 public:
  Unpacker(const PackedHead& head, std::string_view bits) : head_(head), bits_(bits), small_(head.small_size) {}

  std::vector<float> unpack() {
    if (!prepare()) return {};
    places_.reserve(static_cast<std::size_t>(3 * head_.count));
    int run = 0;  // numbers of a run: three for each place; it stays until another is given
    while (has_room(1)) {
      std::int64_t here[3];
      take_whole(here);
      int change = 0;
      if (bits_.take(1) != 0) {
        run = static_cast<int>(bits_.take(5));
        change = run % 3 - 1;
        run -= run % 3;
      }
      if (bits_.failed() || !take_run(run / 3, here)) return {};
      if (!change_size(change)) return {};
    }
    return std::move(places_);
  }

 private:
  bool has_room(std::int64_t places) const {
    return static_cast<std::int64_t>(places_.size()) / 3 + places <= head_.count;
  }

  bool prepare() {
    if (!(head_.precision > 0) || head_.count <= 0 || small_ < kFirstSize || small_ > kNoSize) return false;
    bool apart = false;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t size = std::int64_t{head_.highest[k]} - head_.lowest[k] + 1;
      if (size < 1 || size > std::int64_t{0xFFFFFFFF}) return false;
      sizes_[k] = static_cast<std::uint32_t>(size);
      apart = apart || sizes_[k] > kLargestMixedBase;
    }
    whole_bits_ = apart ? 0 : bits_of_base(sizes_);
    unit_ = 1.0F / head_.precision;
    return true;
  }

  void take_whole(std::int64_t (&place)[3]) {
    if (whole_bits_ > 0) {
      bits_.take_three(whole_bits_, sizes_, place);
    } else {
      for (int k = 0; k < 3; ++k) place[k] = bits_.take(bits_below(sizes_[k]));
    }
    for (int k = 0; k < 3; ++k) place[k] += head_.lowest[k];
  }

  // The places near `before`, and that one.
  bool take_run(int count, std::int64_t (&before)[3]) {
    if (!has_room(count + 1)) return false;
    if (count == 0) {
      put(before);
      return true;
    }
    if (small_ == kNoSize) return false;
    const auto size = static_cast<std::uint32_t>(kSizes[static_cast<std::size_t>(small_)]);
    const std::uint32_t sizes[3] = {size, size, size};
    for (int i = 0; i < count; ++i) {
      std::int64_t here[3];
      bits_.take_three(small_, sizes, here);
      for (int k = 0; k < 3; ++k) here[k] += before[k] - size / 2;
      put(here);
      if (i == 0) put(before);  // exchanged
      std::copy(here, here + 3, before);
    }
    return !bits_.failed();
  }

  bool change_size(int change) {
    small_ += change;
    return small_ >= kFirstSize && small_ <= kNoSize;
  }

  void put(const std::int64_t (&place)[3]) {
    for (const std::int64_t number : place)
      places_.push_back(static_cast<float>(static_cast<std::int32_t>(number)) * unit_);
  }

  const PackedHead& head_;
  BitReader bits_;
  std::int32_t small_;
  std::uint32_t sizes_[3] = {};
  int whole_bits_ = 0;
  float unit_ = 0;
  std::vector<float> places_;
};

}  // namespace

std::vector<float> unpack_places(const PackedHead& head, std::string_view bits) {
  return Unpacker(head, bits).unpack();
}

}  // namespace bihive
