// bihive measure: area and volume of the union of all spheres.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/selection.h"
#include "bihive/measure/buried_area.h"
#include "bihive/measure/union_measures.h"
#include "commands/commands.h"
#include "commands/measure_groups.h"
#include "commands/measure_tables.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/thread_reserve.h"
#include "support/write_together.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

struct GroupSum {
  std::string name;
  std::int64_t spheres = 0, exposed = 0;
  double area = 0;
};

std::vector<GroupSum> sums_of(const SphereGroups& groups, const std::vector<double>& areas) {
  std::vector<GroupSum> sums(groups.names.size());
  for (std::size_t g = 0; g < sums.size(); ++g) sums[g].name = groups.names[g];
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (groups.group_of_sphere[i] < 0) continue;
    GroupSum& sum = sums[groups.group_of_sphere[i]];
    ++sum.spheres;
    sum.exposed += areas[i] > 0 ? 1 : 0;
    sum.area += areas[i];
  }
  return sums;
}

// All that the report and the files say.
struct Report {
  std::string name;
  std::int64_t spheres = 0, exposed = 0;
  double probe = 0;
  bool periodic = false, has_cell = false;
  UnionMeasures measures;
  std::string by;
  std::vector<GroupSum> sums;
  std::vector<std::string> groups;
  std::optional<BuriedAreas> buried;

  double cavity_volume() const {
    double sum = 0;
    for (const Cavity& cavity : measures.cavities) sum += cavity.volume;
    return sum;
  }
  double cavity_area() const {
    double sum = 0;
    for (const Cavity& cavity : measures.cavities) sum += cavity.area;
    return sum;
  }
};

std::string json_of(const Report& report) {
  const UnionMeasures& measures = report.measures;
  ordered_json json;
  json["name"] = report.name;
  json["spheres"] = report.spheres;
  json["probe"] = report.probe;
  json["periodic"] = report.periodic;
  json["area"] = measures.area;
  json["area_error"] = measures.area_error;
  json["volume"] = measures.volume;
  json["volume_error"] = measures.volume_error;
  if (!std::isnan(measures.porosity)) {
    json["cell_volume"] = measures.cell_volume;
    json["porosity"] = measures.porosity;
    json["porosity_error"] = measures.porosity_error;
  }
  json["exposed"] = report.exposed;
  json["components"] = measures.components;
  json["undecided_spheres"] = measures.undecided_spheres;
  json["cavities"] = measures.cavities.size();
  json["cavity_volume"] = report.cavity_volume();
  json["cavity_area"] = report.cavity_area();
  if (report.periodic) {
    json["channels"] = ordered_json::array();
    for (const PercolatingSurface& channel : measures.channels)
      json["channels"].push_back(
          {{"area", channel.area}, {"translations", channel.translations}, {"spheres", channel.spheres}});
  }
  if (!report.by.empty()) {
    json["by"] = report.by;
    json["groups"] = ordered_json::array();
    for (const GroupSum& sum : report.sums)
      json["groups"].push_back(
          {{"name", sum.name}, {"spheres", sum.spheres}, {"exposed", sum.exposed}, {"area", sum.area}});
  }
  if (report.buried) {
    json["buried"] = {{"groups", report.groups}, {"alone", report.buried->alone}, {"area", ordered_json::array()}};
    const std::size_t count = report.groups.size();
    for (std::size_t g = 0; g < count; ++g)
      json["buried"]["area"].push_back(
          std::vector<double>(report.buried->buried.begin() + std::ptrdiff_t(g * count),
                              report.buried->buried.begin() + std::ptrdiff_t((g + 1) * count)));
    json["buried"]["error"] = report.buried->error;
  }
  return json.dump(-1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

std::string text_of(const PercolatingSurface& channel) {
  std::string text;
  for (const auto& counts : channel.translations)
    text += fmt::format("{}({} {} {})", text.empty() ? "" : ", ", counts[0], counts[1], counts[2]);
  return text;
}

std::string text_of(const Report& report) {
  const UnionMeasures& measures = report.measures;
  const auto name_of = [](const std::string& name) { return name.empty() ? "(none)" : escaped(name); };
  std::string text = fmt::format(
      "{}: {} sphere{}{}, {} exposed\n", escaped(report.name), grouped(report.spheres), report.spheres == 1 ? "" : "s",
      report.probe > 0 ? fmt::format(" with a probe of {}", report.probe) : "", grouped(report.exposed));
  text += fmt::format("  area    {:.12g}\n  volume  {:.12g}\n", measures.area, measures.volume);
  if (!std::isnan(measures.porosity))
    text += fmt::format("  cell    {:.12g}, porosity {:.12g}\n", measures.cell_volume, measures.porosity);
  text += fmt::format("  {} connected part{}, ", grouped(measures.components), measures.components == 1 ? "" : "s");
  text += measures.cavities.empty()
              ? std::string("no cavity\n")
              : fmt::format("{} {} of volume {:.12g} and area {:.12g}\n", grouped(std::ssize(measures.cavities)),
                            measures.cavities.size() == 1 ? "cavity" : "cavities", report.cavity_volume(),
                            report.cavity_area());
  for (const PercolatingSurface& channel : measures.channels)
    text += fmt::format("  channel along {} of the cell, of area {:.12g}\n", text_of(channel), channel.area);
  if (report.has_cell && !report.periodic) text += "  images of the periodic cell do not count without --periodic\n";
  if (!report.by.empty()) {
    text += fmt::format("area by {}:\n", escaped(report.by));
    for (const GroupSum& sum : report.sums)
      text += fmt::format("  {}  {:.12g}, {} of {} exposed\n", name_of(sum.name), sum.area, grouped(sum.exposed),
                          grouped(sum.spheres));
  }
  if (report.buried) {
    text += "buried area, of both sides:\n";
    const std::size_t count = report.groups.size();
    bool any = false;
    for (std::size_t g = 0; g < count; ++g)
      for (std::size_t h = g + 1; h < count; ++h) {
        const double area = report.buried->buried[g * count + h];
        if (!(area > report.buried->error)) continue;
        text += fmt::format("  {} | {}  {:.12g}\n", name_of(report.groups[g]), name_of(report.groups[h]), area);
        any = true;
      }
    if (!any) text += "  none\n";
  }
  return text;
}

// Shows the progress of a call that is watched (base/watch.h).
template <class Call>
auto with_progress(const char* what, const Call& call) {
  Progress progress(what);
  const Watch watch([&](double done) { progress.update(done); });
  return call();
}

void check_usage(const MeasureCommandOptions& options) {
  refuse_copies(options.input, "bihive measure takes the stored spheres");
  if (options.json && on_standard_output(outputs_of(options)))
    fail_usage("--json and a table on - would share the standard output");
  if (options.groups.size() == 1) fail_setting("group", " is given once", "a buried area needs two groups or more");
  if (!options.buried.empty() && options.groups.empty() && options.by.empty())
    fail_setting("buried", ": there are no groups", "name them by --group, twice or more, or by --by COLUMN");
}

}  // namespace

void run_measure(const MeasureCommandOptions& options) {
  check_usage(options);
  if (options.frames) return run_measure_frames(options);
  const Input input = load_input(options.input);
  check_outputs(outputs_of(options), input.files, /*are_text=*/true);
  const SphereSet& spheres = input.scene.spheres;
  Report report;
  report.name = input.scene.name;
  report.spheres = spheres.size();
  report.probe = options.probe;
  report.periodic = options.input.reading.has("periodic");
  report.has_cell = spheres.cell().has_value();
  std::vector<std::uint8_t> mask;
  MeasureOptions measure;
  if (!options.select.empty()) {
    mask = selected_or_fail(spheres, options.select, "select");
    report.spheres = std::count(mask.begin(), mask.end(), std::uint8_t{1});
    if (report.spheres == 0) fail({"no sphere is selected by " + options.select, "", 0, 0, "bihive select counts"});
    measure.mask = mask.data();
  }
  std::optional<SphereGroups> by, groups;
  if (!options.by.empty()) by = groups_by_column(spheres, options.by, measure.mask);
  if (!options.groups.empty())
    groups = groups_by_selections(spheres, options.groups, measure.mask);
  else if (!options.buried.empty())
    groups = by;

  measure.probe = options.probe;
  measure.threads = static_cast<int>(options.threads);
  measure.periodic = report.periodic;
  measure.cavities = true;
  measure.sphere_volumes = !options.per_sphere.empty();
  measure.contacts = !options.contacts.empty();
  report.measures = value_or_fail(with_progress("measuring", [&] { return measure_union(spheres, measure); }));
  const UnionMeasures& measures = report.measures;
  if (measures.undecided_spheres > 0)
    warn("the pieces of " + grouped(measures.undecided_spheres) +
         " spheres could not be told apart: cavities and connected parts may be wrong");
  report.exposed =
      std::count_if(measures.sphere_area.begin(), measures.sphere_area.end(), [](double area) { return area > 0; });
  if (by) {
    report.by = options.by;
    report.sums = sums_of(*by, measures.sphere_area);
  }
  if (groups) {
    report.groups = groups->names;
    report.buried = value_or_fail(
        with_progress("comparing groups", [&] { return buried_areas(spheres, groups->group_of_sphere, measure); }));
  }

  std::vector<std::string> tables;
  std::vector<std::string> paths;
  const auto write = [&](const std::string& path, const auto& table) {
    if (path.empty()) return;
    paths.push_back(output_path(path));
    tables.push_back(table());
  };
  write(options.per_sphere, [&] { return table_of_spheres(spheres, options.probe, measures, measure.mask); });
  write(options.cavities, [&] { return table_of_cavities(spheres, measures.cavities); });
  write(options.contacts, [&] { return table_of_contacts(measures.contacts, report.periodic); });
  write(options.buried, [&] { return table_of_buried(report.groups, *report.buried); });
  std::vector<FileToWrite> files;
  for (std::size_t i = 0; i < paths.size(); ++i) files.push_back({paths[i], tables[i]});
  write_together(files);
  if (options.json) return print(json_of(report));
  print_report(text_of(report), outputs_of(options));
}

}  // namespace bihive::cli
