// Offsets of parts of a text, in a few bytes each: a film of a long trajectory knows where all its frames lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bihive {

/// Bytes `begin` to `end` of a file, and the number of lines before them.
struct TextPlace {
  std::int64_t begin = 0, end = 0, lines_before = 0;
};

/// Most places follow each other: each is kept as its differences from the one before. Any numbers can be kept.
class PlaceList {
 public:
  class Iterator;

  void push_back(const TextPlace& place);
  void set_last_end(std::int64_t end) { last_.end = end; }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const TextPlace& back() const { return last_; }
  /// Decodes up to kSpacing places.
  TextPlace operator[](std::size_t i) const;

  Iterator begin() const;
  Iterator end() const;

 private:
  static constexpr std::size_t kSpacing = 64;

  // Decoding can begin here.
  struct Mark {
    std::size_t offset = 0;
    TextPlace before;
  };

  void put(std::int64_t from, std::int64_t to);
  std::int64_t take(std::size_t& offset, std::int64_t from) const;
  TextPlace take(std::size_t& offset, const TextPlace& before) const;

  std::string bytes_;  // of all places but the last
  std::vector<Mark> marks_;
  TextPlace before_last_, last_;
  std::size_t size_ = 0;
};

class PlaceList::Iterator {
 public:
  Iterator(const PlaceList& list, std::size_t at) : list_(&list), at_(at) { decode(); }

  const TextPlace& operator*() const { return place_; }
  Iterator& operator++() {
    ++at_;
    decode();
    return *this;
  }
  bool operator!=(const Iterator& other) const { return at_ != other.at_; }

 private:
  void decode() {
    if (at_ + 1 < list_->size_)
      place_ = list_->take(offset_, place_);
    else
      place_ = list_->last_;
  }

  const PlaceList* list_;
  std::size_t at_, offset_ = 0;
  TextPlace place_;
};

inline PlaceList::Iterator PlaceList::begin() const {
  return {*this, 0};
}
inline PlaceList::Iterator PlaceList::end() const {
  return {*this, size_};
}

}  // namespace bihive
