#include "bihive/job/report_text.h"

#include <nlohmann/json.hpp>

namespace bihive {

std::string as_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', /*ensure_ascii=*/true, nlohmann::ordered_json::error_handler_t::replace);
}

std::string latin1(const std::string& text) {
  std::string converted;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte < 0x80) {
      converted += text[i];
    } else if ((byte == 0xC2 || byte == 0xC3) && (next & 0xC0) == 0x80) {
      converted += static_cast<char>((byte << 6 & 0xC0) | (next & 0x3F));
      ++i;
    } else if ((byte & 0xC0) != 0x80) {
      converted += '?';
    }
  }
  return converted;
}

}  // namespace bihive
