#include "commands/box_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "bihive/base/ascii.h"
#include "bihive/base/json_text.h"
#include "bihive/base/near_name.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/readable.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"

namespace bihive::cli {
namespace {

using workbench::Box;

constexpr const char* kColumns = "xmin,ymin,zmin,xmax,ymax,zmax";
constexpr double kFarthest = 1e37;  // rays are binary32

// One line of the file; a message without the line's number, or an empty text.
std::string read_box(const std::string& line, Box& box) {
  std::array<double, 6> numbers{};
  const std::vector<std::string_view> fields = parts_of(line, ',');
  for (std::size_t column = 0; column < 6; ++column) {
    if (column == fields.size()) return fmt::format("expected six numbers, {}, found {}", kColumns, column);
    const std::string_view field = trim(fields[column]);
    const auto number = parse_double(field);
    if (!number || !(std::abs(*number) <= kFarthest))
      return fmt::format("expected a number up to 1e37, found \"{}\"", field);
    numbers[column] = *number;
  }
  if (fields.size() > 6) return "expected six numbers, found more";
  box = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  for (int axis = 0; axis < 3; ++axis)
    if (box.lo[axis] > box.hi[axis])
      return fmt::format("the box ends before it begins along {}: {} > {}", "xyz"[axis], box.lo[axis], box.hi[axis]);
  return {};
}

std::vector<Box> boxes_of_csv(const std::string& text, const std::string& path) {
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

// A box that ORANGE states; nothing: null, or endless along an axis.
std::optional<Box> box_of_volume(const nlohmann::json& volume, const std::string& where, const std::string& path) {
  const auto found = volume.find("bbox");
  if (found == volume.end() || found->is_null()) return std::nullopt;
  const auto bad = [&](const std::string& what) { fail({where + ": " + what, path, 0, 0, ""}); };
  Box box;
  Vec3d* const ends[] = {&box.lo, &box.hi};
  if (!found->is_array() || found->size() != 2) bad("its bbox is not [[x, y, z], [x, y, z]]");
  bool finite = true;
  for (std::size_t end = 0; end < 2; ++end) {
    const nlohmann::json& point = (*found)[end];
    if (!point.is_array() || point.size() != 3) bad("its bbox is not [[x, y, z], [x, y, z]]");
    for (int axis = 0; axis < 3; ++axis) {
      const nlohmann::json& number = point[static_cast<std::size_t>(axis)];
      if (!number.is_number() && !number.is_null()) bad("its bbox has values other than numbers");
      const double value = number.is_null() ? kFarthest * 10 : number.get<double>();
      finite &= std::abs(value) <= kFarthest;
      (*ends[end])[axis] = value;
    }
  }
  if (!finite) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis)
    if (box.lo[axis] > box.hi[axis]) bad(fmt::format("its bbox ends before it begins along {}", "xyz"[axis]));
  return box;
}

std::string name_of_universe(const nlohmann::json& universe, std::size_t position) {
  if (universe.is_object() && universe.contains("md") && universe["md"].is_object()) {
    const nlohmann::json& md = universe["md"];
    if (md.contains("name") && md["name"].is_string()) return md["name"].get<std::string>();
  }
  return std::to_string(position);
}

BoxFile boxes_of_orange(const std::string& text, const std::string& path, const std::string& universe) {
  const nlohmann::json file = value_or_fail(json_from_text<nlohmann::json>(text, path));
  if (!file.is_object() || !file.contains("universes") || !file["universes"].is_array() || file["universes"].empty())
    fail({"has no universes", path, 0, 0, "boxes of JSON are those of ORANGE (Celeritas)"});
  // The universe, by its name or its position.
  const nlohmann::json& universes = file["universes"];
  std::size_t chosen = universe.empty() ? 0 : universes.size();
  std::vector<std::string> names;
  for (std::size_t u = 0; u < universes.size(); ++u) {
    names.push_back(name_of_universe(universes[u], u));
    if (chosen == universes.size() && (names.back() == universe || std::to_string(u) == universe)) chosen = u;
  }
  if (chosen == universes.size()) {
    const std::string near = near_name(universe, names);
    fail({"has no universe \"" + universe + "\"", path, 0, 0,
          near.empty()
              ? fmt::format("it has {}: the first is {}, the last {}", names.size(), names.front(), names.back())
              : "did you mean " + near + "?"});
  }

  // The boxes of its volumes.
  BoxFile boxes;
  boxes.universe = names[chosen];
  const nlohmann::json& one = universes[chosen];
  if (!one.is_object() || !one.contains("volumes") || !one["volumes"].is_array())
    fail({fmt::format("universe \"{}\" has no volumes", boxes.universe), path, 0, 0, "choose another one"});
  for (std::size_t v = 0; v < one["volumes"].size(); ++v) {
    const std::string where = fmt::format("universe \"{}\", volume {}", boxes.universe, v);
    if (!one["volumes"][v].is_object()) fail({where + " is no object", path, 0, 0, ""});
    if (const std::optional<Box> box = box_of_volume(one["volumes"][v], where, path))
      boxes.boxes.push_back(*box);
    else
      ++boxes.without_box;
  }
  if (boxes.boxes.empty())
    fail({fmt::format("no volume of universe \"{}\" has a finite box", boxes.universe), path, 0, 0,
          "choose another one"});
  return boxes;
}

}  // namespace

BoxFile read_box_file(const std::string& path, const std::string& universe) {
  const std::string text = value_or_fail(read_file(path));
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') return boxes_of_orange(text, path, universe);
  if (!universe.empty()) fail_usage("--universe is of a geometry in JSON, and " + escaped(path) + " is CSV");
  BoxFile boxes;
  boxes.boxes = boxes_of_csv(text, path);
  return boxes;
}

}  // namespace bihive::cli
