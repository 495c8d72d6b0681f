// bihive styles: lists the built-in styles.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/scene/style.h"
#include "commands/commands.h"

namespace bihive::cli {

void run_styles(const StylesOptions& options) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["styles"] = nlohmann::ordered_json::array();
  std::string text;
  for (const std::string& name : style_names()) {
    const Style style = value_or_fail(style_named(name));
    json["styles"].push_back({{"name", name}, {"description", style.description}});
    text += fmt::format("{:<14}{}\n", name, style.description);
  }
  print(options.json ? json.dump(2) + "\n" : text);
}

}  // namespace bihive::cli
