#include "server/url.h"

#include <algorithm>

#include "bihive/base/ascii.h"
#include "server/addresses.h"

namespace bihive::cli {
namespace {

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 && std::all_of(text.begin(), text.end(), is_digit);
}

}  // namespace

std::string url_escaped(std::string_view text) {
  const char* const digits = "0123456789ABCDEF";
  std::string escaped;
  for (const char c : text) {
    if (is_letter_or_digit(c) || c == '-' || c == '.' || c == '_' || c == '~') {
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
  for (const char c : name)
    if (!is_letter_or_digit(c) && c != '-' && c != '.' && c != '_') return std::nullopt;
  if (name.empty()) return std::nullopt;
  return lower_case(name);
}

}  // namespace bihive::cli
