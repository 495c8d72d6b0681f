// The hash that tells whether a file still has the bytes that bihive wrote.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bihive::cli {

/// 64-bit FNV-1a; `before`: the hash of the preceding bytes.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u);
/// The hash of an open file, from its position on; `path` is for messages. Fails with kBadInput.
std::uint64_t hash_of_file(int file, const std::string& path);

/// As 16 hexadecimal digits, and back; nothing if a text is none.
std::string hash_text(std::uint64_t hash);
std::optional<std::uint64_t> hash_from_text(std::string_view text);

}  // namespace bihive::cli
