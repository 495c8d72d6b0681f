#include "bihive/io/frames/place_list.h"

namespace bihive {
namespace {

constexpr unsigned kBitsPerByte = 7;
constexpr std::uint64_t kMoreFollow = 1u << kBitsPerByte;

}  // namespace

void PlaceList::push_back(const TextPlace& place) {
  if (size_ > 0) {
    if ((size_ - 1) % kSpacing == 0) marks_.push_back({bytes_.size(), before_last_});
    put(before_last_.end, last_.begin);
    put(last_.begin, last_.end);
    put(before_last_.lines_before, last_.lines_before);
    before_last_ = last_;
  }
  last_ = place;
  ++size_;
}

TextPlace PlaceList::operator[](std::size_t i) const {
  if (i + 1 >= size_) return last_;
  const Mark& mark = marks_[i / kSpacing];
  std::size_t offset = mark.offset;
  TextPlace place = mark.before;
  for (std::size_t k = i - i % kSpacing; k <= i; ++k) place = take(offset, place);
  return place;
}

// The difference, modulo 2^64, in groups of seven bits; its sign is the lowest bit.
void PlaceList::put(std::int64_t from, std::int64_t to) {
  const std::uint64_t difference = static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
  const bool is_negative = difference >> 63u != 0;
  std::uint64_t rest = difference << 1u ^ (is_negative ? ~std::uint64_t{0} : 0);
  for (; rest >= kMoreFollow; rest >>= kBitsPerByte) bytes_ += static_cast<char>(rest % kMoreFollow | kMoreFollow);
  bytes_ += static_cast<char>(rest);
}

std::int64_t PlaceList::take(std::size_t& offset, std::int64_t from) const {
  std::uint64_t rest = 0;
  unsigned shift = 0;
  std::uint64_t byte = kMoreFollow;
  for (; byte >= kMoreFollow; shift += kBitsPerByte) {
    byte = static_cast<unsigned char>(bytes_[offset++]);
    rest |= byte % kMoreFollow << shift;
  }
  const std::uint64_t difference = rest >> 1u ^ ((rest & 1u) != 0 ? ~std::uint64_t{0} : 0);
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(from) + difference);
}

TextPlace PlaceList::take(std::size_t& offset, const TextPlace& before) const {
  TextPlace place;
  place.begin = take(offset, before.end);
  place.end = take(offset, place.begin);
  place.lines_before = take(offset, before.lines_before);
  return place;
}

}  // namespace bihive
