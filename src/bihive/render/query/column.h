// A column of numbers that keeps its memory. Its user writes each number before reading it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace bihive {

/// Vector code may read and write up to this many entries past the last.
constexpr std::int64_t kColumnPadding = 16;

template <class T>
class Column {
 public:
  /// Makes room for n entries and the padding. The old content is lost; nothing is initialised.
  void reserve(std::int64_t n) {
    if (n <= capacity_) return;
    memory_.reset(new T[static_cast<std::size_t>(n + kColumnPadding)]);
    capacity_ = n;
  }

  T* data() { return memory_.get(); }
  const T* data() const { return memory_.get(); }
  T& operator[](std::int64_t i) { return memory_[static_cast<std::size_t>(i)]; }
  const T& operator[](std::int64_t i) const { return memory_[static_cast<std::size_t>(i)]; }

 private:
  std::unique_ptr<T[]> memory_;
  std::int64_t capacity_ = 0;
};

/// Three columns: of x, y and z, or of red, green and blue.
template <class T>
struct Columns3 {
  Column<T> column[3];

  void reserve(std::int64_t n) {
    for (Column<T>& each : column) each.reserve(n);
  }
  Column<T>& operator[](int i) { return column[i]; }
  const Column<T>& operator[](int i) const { return column[i]; }
};

}  // namespace bihive
