// Numbers and arrays as the bytes of a message between processes of one program, on machines of one kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "bihive/base/check.h"

namespace bihive {

using Bytes = std::vector<char>;

class ByteWriter {
 public:
  explicit ByteWriter(Bytes& bytes) : bytes_(bytes) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_array(&value, 1);
  }
  template <class T>
  void put_array(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t before = bytes_.size();
    bytes_.resize(before + count * sizeof(T));
    if (count > 0) std::memcpy(bytes_.data() + before, values, count * sizeof(T));
  }
  void put_text(const std::string& text) {
    put(static_cast<std::int64_t>(text.size()));
    put_array(text.data(), text.size());
  }

 private:
  Bytes& bytes_;
};

/// Reads in the order of writing. Reading beyond the end is a programmer's error: both sides are this program.
class ByteReader {
 public:
  explicit ByteReader(const Bytes& bytes) : bytes_(bytes) {}

  template <class T>
  T take() {
    T value;
    take_array(&value, 1);
    return value;
  }
  template <class T>
  void take_array(T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    BIHIVE_CHECK_LE(at_ + count * sizeof(T), bytes_.size());
    if (count > 0) std::memcpy(static_cast<void*>(values), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  std::string take_text() {
    std::string text(static_cast<std::size_t>(take<std::int64_t>()), '\0');
    take_array(text.data(), text.size());
    return text;
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

}  // namespace bihive
