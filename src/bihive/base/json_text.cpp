#include "bihive/base/json_text.h"

#include <cstddef>

namespace bihive {

Status check_json_depth(std::string_view text, const std::string& name) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if ((c == '[' || c == '{') && ++depth > kMostJsonDepth) {
      std::int64_t line = 1;
      std::size_t begin = 0;
      for (std::size_t k = 0; k < i; ++k)
        if (text[k] == '\n') {
          ++line;
          begin = k + 1;
        }
      return Error{"arrays and objects lie more than " + std::to_string(kMostJsonDepth) + " deep in each other", name,
                   line, static_cast<std::int64_t>(i - begin) + 1, ""};
    }
  }
  return Done{};
}

}  // namespace bihive
