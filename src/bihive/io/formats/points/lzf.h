// LZF, the packing of point clouds [PCD]: literals and copies of what was unpacked before.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

/// The unpacked bytes, or nothing if the packed ones are damaged or do not give exactly `size` bytes.
inline std::optional<std::string> unpack_lzf(std::string_view packed, std::size_t size) {
  // One byte of a copy stands for at most 264 / 3 bytes, so a wrong size is found before memory is taken for it.
  if (size / 88 > packed.size()) return std::nullopt;
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto next = [&] { return static_cast<unsigned char>(packed[at++]); };
  while (at < packed.size()) {
    const unsigned control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - at || length > size - out.size()) return std::nullopt;
      out.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    if (at == packed.size()) return std::nullopt;
    if (length == 9) length += next();
    if (at == packed.size()) return std::nullopt;
    const std::size_t back = ((control & 31U) << 8 | next()) + 1;
    if (back > out.size() || length > size - out.size()) return std::nullopt;
    for (std::size_t i = 0; i < length; ++i) out += out[out.size() - back];
  }
  return out.size() == size ? std::optional<std::string>(std::move(out)) : std::nullopt;
}

}  // namespace bihive
