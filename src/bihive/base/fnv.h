// A quick hash that tells apart what nobody forges; base/sha256.h is for the rest.
#pragma once

#include <cstdint>
#include <string_view>

namespace bihive {

/// 64-bit FNV-1a; `before`: the hash of the preceding bytes.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u) {
  for (const char c : bytes) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return before;
}

}  // namespace bihive
