#include "server/url.h"

#include <algorithm>

#include "server/addresses.h"

namespace bihive::cli {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// The value of a hexadecimal digit, -1 for anything else.
int hex_value(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 && std::all_of(text.begin(), text.end(), is_digit);
}

}  // namespace

std::string url_escaped(std::string_view text) {
  const char* const digits = "0123456789ABCDEF";
  std::string escaped;
  for (const char c : text) {
    if (is_letter(c) || is_digit(c) || c == '-' || c == '.' || c == '_' || c == '~') {
      escaped += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    escaped += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return escaped;
}

std::optional<std::string> url_path(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  if (target.empty() || target.front() != '/') return std::nullopt;
  std::string path;
  for (std::size_t i = 0; i < target.size(); ++i) {
    if (target[i] != '%') {
      path += target[i];
      continue;
    }
    if (i + 2 >= target.size()) return std::nullopt;
    const int high = hex_value(target[i + 1]);
    const int low = hex_value(target[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    const int byte = 16 * high + low;
    if (byte == 0 || byte == '/') return std::nullopt;
    path += static_cast<char>(byte);
    i += 2;
  }
  return path;
}

std::optional<std::string> host_name(std::string_view header) {
  std::string_view name = header;
  std::string_view after;
  if (!header.empty() && header.front() == '[') {
    const std::size_t end = header.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    name = header.substr(1, end - 1);
    after = header.substr(end + 1);
    if (name.find(':') == std::string_view::npos) return std::nullopt;
  } else {
    const std::size_t colon = header.find(':');
    name = header.substr(0, colon);
    if (colon != std::string_view::npos) after = header.substr(colon);
  }
  if (!after.empty() && (after.front() != ':' || !is_port(after.substr(1)))) return std::nullopt;
  if (const std::optional<std::string> address = usual_spelling(std::string(name))) return address;
  std::string small;
  for (const char c : name) {
    if (!is_letter(c) && !is_digit(c) && c != '-' && c != '.' && c != '_') return std::nullopt;
    small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  if (small.empty()) return std::nullopt;
  return small;
}

}  // namespace bihive::cli
