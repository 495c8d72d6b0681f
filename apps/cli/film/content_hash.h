// The hash that tells whether a file still has the bytes that bihive wrote.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bihive::cli {

/// fnv1a() of an open file, from its position on; `path` is for messages. Fails with kBadInput.
std::uint64_t hash_of_file(int file, const std::string& path);

/// As 16 hexadecimal digits, and back; nothing if a text is none.
std::string hash_text(std::uint64_t hash);
std::optional<std::uint64_t> hash_from_text(std::string_view text);

}  // namespace bihive::cli
