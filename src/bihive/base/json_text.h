// Untrusted JSON: its depth is limited before a document is built. nlohmann's documents recurse when they are copied,
// compared, written or freed, so endless brackets would overflow the stack.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "bihive/base/result.h"

namespace bihive {

/// No document of this project comes near it.
constexpr int kMostJsonDepth = 64;

/// An error, with line and column, where more than kMostJsonDepth arrays and objects are open. Text that is not JSON
/// passes: a parser stops where it stops being JSON, and up to that point this counts as the parser does. `name` is the
/// file's name for the message.
Status check_json_depth(std::string_view text, const std::string& name);

/// The document, as nlohmann::json or nlohmann::ordered_json: the only way from text to a document, besides
/// parse_json() of scene files (scripts/check_includes). Errors: too deep; not valid JSON.
template <class Json>
Result<Json> json_from_text(std::string_view text, const std::string& name = "") {
  if (Status status = check_json_depth(text, name); !status) return status.error();
  Json document = Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
  if (document.is_discarded()) return Error{"it is not valid JSON", name, 0, 0, ""};
  return Result<Json>(std::move(document));
}

}  // namespace bihive
