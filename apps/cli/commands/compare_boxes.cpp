// bihive compare --boxes: structures over boxes.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/base/readable.h"
#include "bihive/base/version.h"
#include "bihive/compare/box_queries.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "commands/box_file.h"
#include "commands/commands.h"
#include "commands/compare_text.h"

namespace bihive::cli {
namespace {

using workbench::BoxKindResult;
using workbench::BoxStructureResult;

std::string table_of(const std::vector<BoxStructureResult>& results, const char* name,
                     const BoxKindResult BoxStructureResult::*kind) {
  std::string text =
      fmt::format("\n{}: {}; each {} {} boxes on average\n", name, grouped((results[0].*kind).queries),
                  name == std::string("rays") ? "ray meets" : "point lies in", short_number((results[0].*kind).found));
  text += fmt::format("{:<12}{:>10}{:>12}{:>14}{:>18}\n", "structure", "M/s", "nodes", "box tests", "tests in leaves");
  for (const BoxStructureResult& one : results) {
    const BoxKindResult& result = one.*kind;
    text += fmt::format("{:<12}{:>10}{:>12}{:>14}{:>18}\n", one.row.name,
                        short_number(static_cast<double>(result.queries) / result.ms / 1000),
                        short_number(result.nodes), short_number(result.box_tests), short_number(result.item_tests));
  }
  return text;
}

nlohmann::ordered_json json_of_kind(const BoxKindResult& result) {
  return {{"queries", result.queries},
          {"ms", result.ms},
          {"nodes", result.nodes},
          {"box_tests", result.box_tests},
          {"tests_in_leaves", result.item_tests},
          {"found", result.found},
          {"different", result.different}};
}

}  // namespace

void run_compare_boxes(const CompareOptions& options) {
  if (!options.structures.empty() || !options.kinds.empty() || !options.sweep.empty() || !options.output.empty() ||
      !options.select.empty() || options.pixel)
    fail_usage("--boxes compares all its structures by rays and points, and prints the result",
               "leave out --structures, --rays, --sweep, --select, --pixel and -o");
  const std::string& path = options.input.input;
  const BoxFile file = read_box_file(path, options.universe);
  const std::vector<workbench::Box>& boxes = file.boxes;
  if (file.without_box > 0)
    warn(fmt::format("{}: {} volume{} without a finite box {} left out", path, grouped(file.without_box),
                     file.without_box == 1 ? "" : "s", file.without_box == 1 ? "is" : "are"));
  const auto results = value_or_fail(workbench::compare_box_structures(boxes, options.count));
  if (options.json) {
    nlohmann::ordered_json json;
    json["bihive_boxes"] = 1;
    json["version"] = version();
    json["name"] = path;
    if (!file.universe.empty()) json["universe"] = file.universe;
    json["boxes"] = boxes.size();
    json["structures"] = nlohmann::ordered_json::array();
    for (const BoxStructureResult& one : results)
      json["structures"].push_back({{"name", one.row.name},
                                    {"title", one.row.title},
                                    {"build_ms", one.build_ms},
                                    {"bytes", one.facts.bytes},
                                    {"nodes", one.facts.nodes},
                                    {"depth", one.facts.depth},
                                    {"rays", json_of_kind(one.rays)},
                                    {"points", json_of_kind(one.points)}});
    print(json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  } else {
    std::string text = fmt::format("{}{}: {} box{}, 1 thread\n\n", escaped(path),
                                   file.universe.empty() ? "" : ", universe " + escaped(file.universe),
                                   grouped(std::ssize(boxes)), boxes.size() == 1 ? "" : "es");
    text += fmt::format("{:<12}{:>12}{:>12}{:>8}{:>12}\n", "structure", "build", "bytes/box", "levels", "nodes");
    for (const BoxStructureResult& one : results)
      text += fmt::format("{:<12}{:>12}{:>12}{:>8}{:>12}\n", one.row.name, readable_ms(one.build_ms),
                          short_number(static_cast<double>(one.facts.bytes) / static_cast<double>(boxes.size())),
                          one.facts.depth, grouped(one.facts.nodes));
    text += table_of(results, "rays", &BoxStructureResult::rays);
    text += table_of(results, "points", &BoxStructureResult::points);
    const bool same = std::all_of(results.begin(), results.end(), [](const BoxStructureResult& one) {
      return one.rays.different + one.points.different == 0;
    });
    if (same) text += "\nEvery structure finds the boxes of brute force.\n";
    print(text);
  }
  for (const BoxStructureResult& one : results)
    if (one.rays.different + one.points.different > 0)
      fail({fmt::format("{} finds other boxes than brute force for {} rays and {} points", one.row.name,
                        grouped(one.rays.different), grouped(one.points.different)),
            "", 0, 0, "please report it, with the input"});
}

}  // namespace bihive::cli
