#include "compare_options.h"

#include <array>

#include "bihive/base/parse_number.h"
#include "bihive/compare/structure.h"
#include "bihive/select/selection.h"
#include "request_options.h"
#include "value_options.h"

namespace bihive::cli {
namespace {

Result<std::string> checked_selection(const std::string& text) {
  if (const Status status = check_selection(text); !status) return status.error();
  return text;
}

Result<std::string> structure_from(const std::string& name) {
  const Result<workbench::StructureRow> row = workbench::structure_named(name);
  if (!row) return row.error();
  return name;
}

Result<int> threads_from(const std::string& text) {
  const Result<std::int64_t> threads = whole_number_from_text(text, 0, kMostThreads);
  if (!threads) return threads.error();
  return static_cast<int>(*threads);
}

Result<std::pair<int, int>> pixel_from(const std::string& text) {
  constexpr std::int64_t kMost = 32767;
  const std::size_t comma = text.find(',');
  const auto x = parse_int(text.substr(0, comma));
  const auto y = comma == std::string::npos ? std::nullopt : parse_int(text.substr(comma + 1));
  if (!x || !y || *x < 0 || *y < 0 || *x > kMost || *y > kMost)
    return unexpected("a pixel X,Y", text, "0,0 is the top left corner");
  return std::pair(static_cast<int>(*x), static_cast<int>(*y));
}

// The names of a table's rows, as text.
template <class Rows>
std::string names_in(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

void add_query_kinds(CLI::App& command, std::vector<workbench::QueryKind>& kinds) {
  add_value(
      command, "--rays", kinds, "KIND,...",
      in_lines("The rays (all): " + names_in(workbench::kQueryKinds) + "; points ask for the nearest sphere"),
      [](const std::string& text) { return list_from_text<workbench::QueryKind>(text, workbench::query_kind_named); });
}

void add_selection(CLI::App& command, std::string& select) {
  add_value(command, "--select", select, "EXPR", "Only these spheres: docs/selections.md", checked_selection);
}

}  // namespace

void add_compare_options(CLI::App& command, CompareOptions& options) {
  command.add_option("-o,--output", options.output, "Written: a report, one HTML file")->type_name("FILE");
  add_value(command, "--structures", options.structures, "NAME,...",
            in_lines("The structures (all): " + names_in(workbench::structures())),
            [](const std::string& text) { return list_from_text<std::string>(text, structure_from); });
  add_query_kinds(command, options.kinds);
  add_integer(command, "--rays-count", options.count, 1, std::int64_t{1} << 30,
              "Primary and random rays, and points (65536); the other rays start at hits of\nthe primary ones");
  add_value(command, "--threads", options.threads, "N,...",
            in_lines("Threads of all queries, each number in a column of its own; the first one builds the wide tree, "
                     "too; 0: all (1,0)"),
            [](const std::string& text) { return list_from_text<int>(text, threads_from); });
  command
      .add_option("--sweep", options.sweep,
                  in_lines("Build with these values, and mark the best: " + names_in(workbench::kStructureParameters) +
                           "; may be given once for each"))
      ->type_name("NAME=N,...")
      ->expected(1)
      ->take_all();
  add_value(command, "--pixel", options.pixel, "X,Y",
            "Print the path of one primary ray instead: nodes entered and spheres tested", pixel_from);
  add_selection(command, options.select);
  command.add_flag(
      "--boxes", options.boxes,
      in_lines("INPUT has boxes, CSV of xmin,ymin,zmin,xmax,ymax,zmax or a geometry of ORANGE (JSON): find all "
               "boxes of rays and points"));
  command
      .add_option("--universe", options.universe,
                  "With --boxes: the universe of a geometry, by its name or its position (0)")
      ->type_name("NAME|N")
      ->needs("--boxes");
}

void add_tune_options(CLI::App& command, TuneCommandOptions& options) {
  std::vector<workbench::StructureRow> rows = workbench::structures();
  std::erase_if(rows, [](const workbench::StructureRow& row) { return (row.takes & workbench::kTakesMaxPrims) == 0; });
  add_value(command, "--structure", options.structure, "NAME", in_lines("The structure (wide): " + names_in(rows)),
            structure_from);
  add_query_kinds(command, options.kinds);
  add_integer(command, "--rays-count", options.count, 1, std::int64_t{1} << 30,
              "Primary and random rays, and points (4096); the other rays start at hits of\nthe primary ones");
  add_integer(command, "--threads", options.threads, 0, kMostThreads,
              "Threads of all queries, and of the wide tree's build; 0: all (1)");
  add_selection(command, options.select);
}

}  // namespace bihive::cli
