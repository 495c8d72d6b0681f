// SHA-256 [FIPS180]: names bytes, so that a file or a picture can be recognized.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

class Sha256 {
 public:
  void add(std::string_view bytes);
  /// 64 hexadecimal digits of all bytes so far. The last call.
  std::string digits();

 private:
  void take_block(const std::uint8_t* block);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> block_{};
  std::size_t in_block_ = 0;
  std::uint64_t bytes_ = 0;
};

/// Of a file's bytes, read in parts. Error: the file cannot be read.
Result<std::string> sha256_of_file(const std::string& path);

}  // namespace bihive
