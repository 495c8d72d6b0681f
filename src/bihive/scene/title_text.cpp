#include "bihive/scene/title_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "bihive/base/readable.h"

namespace bihive {
namespace {

Error title_error(const std::string& message, const std::string& hint) {
  return {message, "", 0, 0, hint};
}

// The digits after the point of ".2f".
std::optional<int> digits_of(const std::string& form) {
  if (form.size() != 3 || form[0] != '.' || form[1] < '0' || form[1] > '9' || form[2] != 'f') return std::nullopt;
  return form[1] - '0';
}

// The text of "name" or "name:.2f".
Result<std::string> value_text(const std::string& words, const TitleValues& values) {
  const std::size_t colon = words.find(':');
  const std::string name = words.substr(0, colon);
  const auto found = std::find_if(values.begin(), values.end(), [&](const auto& one) { return one.first == name; });
  if (found == values.end()) {
    std::string names;
    for (const auto& one : values) names += (names.empty() ? "{" : ", {") + one.first + "}";
    return title_error("a title knows no {" + words + "}", "there are " + names + "; {{ is a brace");
  }
  if (std::isnan(found->second))
    return title_error("the frame does not state its " + name + ", which the title asks for",
                       "leave {" + words + "} out");
  if (colon == std::string::npos) {
    const bool whole = std::abs(found->second) < 1e15 && found->second == std::floor(found->second);
    return whole ? fmt::format("{:.0f}", found->second) : readable_number(found->second);
  }
  const std::optional<int> digits = digits_of(words.substr(colon + 1));
  if (!digits)
    return title_error("expected {" + name + "} or {" + name + ":.2f} in the title, found {" + words + "}",
                       "the digit says how many digits follow the point");
  return fmt::format("{:.{}f}", found->second, *digits);
}

}  // namespace

Result<std::string> fill_title(const std::string& text, const TitleValues& values) {
  std::string filled;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '{' && c != '}') {
      filled += c;
      continue;
    }
    if (i + 1 < text.size() && text[i + 1] == c) {
      filled += c;
      ++i;
      continue;
    }
    const std::size_t end = c == '{' ? text.find('}', i) : std::string::npos;
    if (end == std::string::npos)
      return title_error(std::string("the title has a ") + c + " without its partner", "write {{ or }} for a brace");
    const Result<std::string> value = value_text(text.substr(i + 1, end - i - 1), values);
    if (!value) return value.error();
    filled += *value;
    i = end;
  }
  return filled;
}

}  // namespace bihive
