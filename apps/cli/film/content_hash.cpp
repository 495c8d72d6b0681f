#include "film/content_hash.h"

#include <unistd.h>

#include <cerrno>
#include <cstddef>

#include "bihive/base/fnv.h"
#include "bihive/job/film/system_failure.h"

namespace bihive::cli {
namespace {

constexpr int kHashDigits = 16;

}  // namespace

std::uint64_t hash_of_file(int file, const std::string& path) {
  std::uint64_t hash = fnv1a("");
  char buffer[1 << 16];
  for (;;) {
    const ssize_t count = read(file, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_of_system("cannot be read", path, errno);
    if (count == 0) return hash;
    hash = fnv1a({buffer, static_cast<std::size_t>(count)}, hash);
  }
}

std::string hash_text(std::uint64_t hash) {
  std::string digits(kHashDigits, '0');
  for (int i = kHashDigits - 1; i >= 0; --i, hash >>= 4u)
    digits[static_cast<std::size_t>(i)] = "0123456789abcdef"[hash & 15u];
  return digits;
}

std::optional<std::uint64_t> hash_from_text(std::string_view text) {
  if (text.size() != kHashDigits) return std::nullopt;
  std::uint64_t hash = 0;
  for (const char c : text) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    hash = hash << 4u | digit;
  }
  return hash;
}

}  // namespace bihive::cli
