// bihive compare --boxes: structures over boxes.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/base/readable.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/compare/box_queries.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "commands/commands.h"
#include "commands/compare_text.h"

namespace bihive::cli {
namespace {

using workbench::Box;
using workbench::BoxKindResult;
using workbench::BoxStructureResult;

constexpr const char* kColumns = "xmin,ymin,zmin,xmax,ymax,zmax";
constexpr double kFarthest = 1e37;  // rays are binary32

// One line of the file; a message without the line's number, or an empty text.
std::string read_box(const std::string& line, Box& box) {
  std::array<double, 6> numbers{};
  std::size_t first = 0;
  for (std::size_t column = 0; column < 6; ++column) {
    if (first > line.size()) return fmt::format("expected six numbers, {}, found {}", kColumns, column);
    const std::size_t end = std::min(line.find(',', first), line.size());
    std::string field = line.substr(first, end - first);
    field.erase(0, field.find_first_not_of(" \t"));
    field.erase(field.find_last_not_of(" \t") + 1);
    const auto number = parse_double(field);
    if (!number || !(std::abs(*number) <= kFarthest))
      return fmt::format("expected a number up to 1e37, found \"{}\"", field);
    numbers[column] = *number;
    first = end + 1;
  }
  if (first <= line.size()) return "expected six numbers, found more";
  box = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  for (int axis = 0; axis < 3; ++axis)
    if (box.lo[axis] > box.hi[axis])
      return fmt::format("the box ends before it begins along {}: {} > {}", "xyz"[axis], box.lo[axis], box.hi[axis]);
  return {};
}

std::vector<Box> boxes_of_file(const std::string& path) {
  const std::string text = value_or_fail(read_file(path));
  std::vector<Box> boxes;
  std::int64_t number = 0;
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find('\n', first), text.size());
    std::string line = text.substr(first, end - first);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    first = end + 1;
    ++number;
    if (line.empty() || line.front() == '#' || (boxes.empty() && line == kColumns)) continue;
    Box box;
    if (const std::string fault = read_box(line, box); !fault.empty())
      fail({fault, path, number, 0, std::string("a line of boxes is ") + kColumns});
    boxes.push_back(box);
  }
  if (boxes.empty()) fail({"there is no box", path, 0, 0, std::string("a line of boxes is ") + kColumns});
  return boxes;
}

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
  const std::vector<Box> boxes = boxes_of_file(path);
  const auto results = value_or_fail(workbench::compare_box_structures(boxes, options.count));
  if (options.json) {
    nlohmann::ordered_json json;
    json["bihive_boxes"] = 1;
    json["version"] = version();
    json["name"] = path;
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
    std::string text = fmt::format("{}: {} box{}, 1 thread\n\n", escaped(path), grouped(std::ssize(boxes)),
                                   boxes.size() == 1 ? "" : "es");
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
