#include "support/report_text.h"

#include <nlohmann/json.hpp>

namespace bihive::cli {

std::string as_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', /*ensure_ascii=*/true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace bihive::cli
