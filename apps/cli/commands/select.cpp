// bihive select: counts and lists the spheres that an expression selects.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bihive/job/messages.h"
#include "bihive/job/selection.h"
#include "bihive/select/selection.h"
#include "commands/commands.h"

namespace bihive::cli {
namespace {

// The ids as ranges, in the language of selections: "index 0..34 70 90..99".
std::string ids_as_ranges(const std::vector<std::uint8_t>& mask) {
  std::string text;
  for (std::size_t first = 0; first < mask.size(); ++first) {
    if (mask[first] == 0) continue;
    std::size_t last = first;
    while (last + 1 < mask.size() && mask[last + 1] != 0) ++last;
    text += first == last ? fmt::format(" {}", first) : fmt::format(" {}..{}", first, last);
    first = last;
  }
  return text.empty() ? "none" : "index" + text;
}

}  // namespace

void run_select(const SelectOptions& options) {
  refuse_copies(options.input, "bihive select counts the stored spheres");
  const Input input = load_input(options.input);
  const SphereSet& spheres = input.scene.spheres;
  const std::vector<std::uint8_t> mask = selected_or_fail(spheres, options.expression, "EXPRESSION");
  const std::int64_t count = std::count(mask.begin(), mask.end(), std::uint8_t{1});
  const std::string reason = count == 0 ? what_there_is(spheres, options.expression) : "";
  if (!reason.empty()) warn(reason);
  const bool periodic = sees_images(spheres, options.expression);
  if (!options.json) {
    print(fmt::format("{}: {} of {} spheres{}\n{}\n", escaped(input.scene.name), grouped(count),
                      grouped(spheres.size()), periodic ? ", periodic cell" : "", ids_as_ranges(mask)));
    return;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["name"] = input.scene.name;
  json["expression"] = options.expression;
  json["spheres"] = spheres.size();
  json["selected"] = count;
  json["periodic"] = periodic;
  json["ids"] = nlohmann::ordered_json::array();
  for (std::size_t id = 0; id < mask.size(); ++id)
    if (mask[id] != 0) json["ids"].push_back(id);
  print(json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace bihive::cli
