// Numbers from bytes, one after the other, in either byte order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace bihive {

enum class ByteOrder { little, big };

class ByteReader {
 public:
  ByteReader(std::string_view bytes, ByteOrder order)
      : bytes_(bytes), swap_((order == ByteOrder::little) != (std::endian::native == std::endian::little)) {}

  std::size_t left() const { return bytes_.size() - at_; }
  /// False, and `bytes` is empty, if there are not as many.
  bool take(std::size_t count, std::string_view& bytes) {
    bytes = {};
    if (count > left()) return false;
    bytes = bytes_.substr(at_, count);
    at_ += count;
    return true;
  }
  bool skip(std::size_t count) {
    std::string_view ignored;
    return take(count, ignored);
  }
  /// A number as it is stored. False, and `value` is 0, if there are too few bytes.
  template <class T>
  bool take(T& value) {
    value = 0;
    std::string_view stored;
    if (!take(sizeof(T), stored)) return false;
    char bytes[sizeof(T)];
    std::copy(stored.begin(), stored.end(), bytes);
    if (swap_) std::reverse(bytes, bytes + sizeof(T));
    std::memcpy(&value, bytes, sizeof(T));
    return true;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool swap_;
};

}  // namespace bihive
