#include "bihive/scene/saved_request.h"

#include <nlohmann/json.hpp>

#include "bihive/scene/scene_json.h"

namespace bihive {

using nlohmann::json;
using nlohmann::ordered_json;

Result<std::optional<SavedRequest>> saved_request_from(std::string_view text, const std::string& name) {
  // Most scenes are large and are none of these.
  if (text.find("\"input\"") == std::string_view::npos) return std::optional<SavedRequest>();
  const Result<json> document = parse_json(text, name);
  if (!document) return document.error();
  if (!document->is_object() || !document->contains("bihive_scene") || !document->contains("input"))
    return std::optional<SavedRequest>();
  if (const Status status = check_against_definition(*document, "saved_request", name); !status) return status.error();
  SavedRequest request{document->at("input").get<std::string>(), {}};
  for (const json& pair : document->value("options", json::array()))
    request.options.emplace_back(pair.at(0).get<std::string>(), pair.size() > 1 ? pair.at(1).get<std::string>() : "");
  return std::optional(std::move(request));
}

std::string to_scene_json(const SavedRequest& request) {
  constexpr int kVersion = 2;
  const auto text = [](const ordered_json& value) {
    return value.dump(-1, ' ', /*ensure_ascii=*/false, ordered_json::error_handler_t::replace);
  };
  // An option on each line.
  std::string document = "{\n  \"bihive_scene\": " + std::to_string(kVersion) +
                         ",\n  \"input\": " + text(request.input) + ",\n  \"options\": [";
  const char* separator = "\n    ";
  for (const auto& [id, value] : request.options) {
    document += separator + (value.empty() ? "[" + text(id) + "]" : "[" + text(id) + ", " + text(value) + "]");
    separator = ",\n    ";
  }
  return document + (request.options.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace bihive
