// Shared by the fuzz targets of whole engines: numbers from any bytes, and answers that must have the same bits.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "bihive/render/tracer.h"
#include "bihive/wide/ray_batch.h"

namespace bihive::fuzz {

inline void demand(bool condition) {
  if (!condition) std::abort();
}

/// Takes numbers from the input one after the other; zeros behind its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool at_end() const { return left_ == 0; }

  template <class T>
  T take() {
    T value{};
    const std::size_t count = std::min(sizeof value, left_);
    if (count > 0) std::memcpy(&value, data_, count);
    data_ += count;
    left_ -= count;
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

struct Answers {
  std::vector<double> t;
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> hidden;

  bool operator==(const Answers& other) const {
    return same_bytes(t, other.t) && same_bytes(id, other.id) && same_bytes(hidden, other.hidden);
  }
};

inline Answers answers_of(const Tracer& tracer, const RayBatch& rays, RayOrder order) {
  const auto count = static_cast<std::size_t>(rays.span().count);
  Answers answers{std::vector<double>(count), std::vector<std::int64_t>(count), std::vector<std::uint8_t>(count)};
  tracer.closest_hits(rays.span(), order, {answers.t.data(), answers.id.data()});
  tracer.occluded(rays.span(), order, answers.hidden.data());
  return answers;
}

}  // namespace bihive::fuzz
