// bihive info --frames: the content of all frames of a file.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/io/frames.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "commands/commands.h"
#include "commands/each_frame.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

// Further ones are only counted.
constexpr std::size_t kMostWarnings = 10;

struct Span {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double value) {
    if (std::isnan(value)) return;
    min = std::min(min, value);
    max = std::max(max, value);
  }
  void add(const Span& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
  }
  bool known() const { return min <= max; }
  ordered_json json() const { return known() ? ordered_json{{"min", min}, {"max", max}} : ordered_json(); }
};

// The content of one frame, or of several.
struct Summary {
  std::string format;
  std::int64_t frames = 0, with_cell = 0;
  Span spheres, axes[3], radius, edges[3], volume, time_ps, step;
  std::vector<std::string> names;  // of the numbers, in the file's order
  std::map<std::string, Span> numbers;
  std::vector<std::string> warnings;

  Span& of_name(const std::string& name) {
    if (numbers.find(name) == numbers.end()) names.push_back(name);
    return numbers[name];
  }

  void add(const Summary& other) {
    format = other.format;
    frames += other.frames;
    with_cell += other.with_cell;
    for (Span Summary::*span :
         {&Summary::spheres, &Summary::radius, &Summary::volume, &Summary::time_ps, &Summary::step})
      (this->*span).add(other.*span);
    for (std::size_t k = 0; k < 3; ++k) {
      axes[k].add(other.axes[k]);
      edges[k].add(other.edges[k]);
    }
    for (const std::string& name : other.names) of_name(name).add(other.numbers.at(name));
    for (const std::string& warning : other.warnings)
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  }
};

Summary summary_of(const SphereFile& file) {
  Summary made;
  const SphereSet& set = file.spheres;
  made.format = file.format;
  made.frames = 1;
  made.spheres.add(static_cast<double>(set.size()));
  const SphereSet::Bounds bounds = set.bounds();
  for (int k = 0; k < 3; ++k) {
    made.axes[k].add(bounds.lo[k]);
    made.axes[k].add(bounds.hi[k]);
  }
  for (std::int64_t id = 0; id < set.size(); ++id) made.radius.add(set.radius(id));
  if (const std::optional<Cell>& cell = set.cell()) {
    made.with_cell = 1;
    const auto& [a, b, c] = cell->vectors;
    for (std::size_t k = 0; k < 3; ++k) made.edges[k].add(length(cell->vectors[k]));
    made.volume.add(std::abs(dot(a, cross(b, c))));
  }
  if (file.time_ps) made.time_ps.add(*file.time_ps);
  if (file.step) made.step.add(static_cast<double>(*file.step));
  for (const NamedNumbers& column : set.attributes().numbers) {
    Span& span = made.of_name(column.name);
    for (const double value : column.values) span.add(value);
  }
  made.warnings = file.warnings;
  return made;
}

Summary summary_of(const Frames& frames) {
  Summary all;
  each_frame<Summary>(
      frames, "reading frames", [](std::int64_t, const SphereFile& file) { return summary_of(file); },
      [&all](const Summary& one) { all.add(one); });
  return all;
}

void print_frames_json(const std::string& name, const Summary& all) {
  const auto three = [](const Span(&spans)[3]) {
    return ordered_json{spans[0].json(), spans[1].json(), spans[2].json()};
  };
  ordered_json json = ordered_json::object();
  json["name"] = name;
  json["format"] = all.format;
  json["frames"] = all.frames;
  json["spheres"] = {{"min", static_cast<std::int64_t>(all.spheres.min)},
                     {"max", static_cast<std::int64_t>(all.spheres.max)}};
  json["bounds"] = {{"lo", {all.axes[0].min, all.axes[1].min, all.axes[2].min}},
                    {"hi", {all.axes[0].max, all.axes[1].max, all.axes[2].max}}};
  json["radius"] = all.radius.json();
  json["cell"] = ordered_json();
  if (all.with_cell > 0)
    json["cell"] = {{"frames", all.with_cell}, {"edges", three(all.edges)}, {"volume", all.volume.json()}};
  json["time_ps"] = all.time_ps.json();
  json["step"] = ordered_json();
  if (all.step.known())
    json["step"] = {{"min", static_cast<std::int64_t>(all.step.min)}, {"max", static_cast<std::int64_t>(all.step.max)}};
  json["attributes"] = ordered_json::array();
  for (const std::string& number : all.names) {
    const Span& span = all.numbers.at(number);
    json["attributes"].push_back({{"name", number},
                                  {"min", span.known() ? ordered_json(span.min) : ordered_json()},
                                  {"max", span.known() ? ordered_json(span.max) : ordered_json()}});
  }
  json["warnings"] = all.warnings;
  print(json.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n");
}

void print_frames_text(const std::string& name, const Summary& all) {
  const auto row = [](const std::string& title, const std::string& value) {
    print(fmt::format("  {:<18}{}\n", escaped(title), escaped(value)));
  };
  // Adding 0 makes 0 of -0.
  const auto interval = [](const Span& span, const char* unit = "") {
    if (!span.known()) return std::string("unknown");
    return span.min == span.max ? fmt::format("{:.9g}{}", span.min + 0, unit)
                                : fmt::format("{:.9g} to {:.9g}{}", span.min + 0, span.max + 0, unit);
  };
  const auto whole = [](const Span& span) {
    const std::string min = grouped(static_cast<std::int64_t>(span.min));
    return span.min == span.max ? min : min + " to " + grouped(static_cast<std::int64_t>(span.max));
  };
  print(
      fmt::format("{}: {}, {} frame{}\n", escaped(name), all.format, grouped(all.frames), all.frames == 1 ? "" : "s"));
  row("spheres", whole(all.spheres));
  const char* const axes[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) row(axes[k], interval(all.axes[k]));
  row("radius", interval(all.radius));
  if (all.with_cell > 0) {
    const char* const edges[] = {"length of cell a", "length of cell b", "length of cell c"};
    for (std::size_t k = 0; k < 3; ++k) row(edges[k], interval(all.edges[k]));
    row("volume of cell", interval(all.volume));
    if (all.with_cell < all.frames) row("", "in " + grouped(all.with_cell) + " of the frames");
  }
  if (all.time_ps.known()) row("time", interval(all.time_ps, " ps"));
  if (all.step.known()) row("step", whole(all.step));
  for (const std::string& number : all.names) row(number, interval(all.numbers.at(number)));
}

}  // namespace

void run_info_of_frames(const InfoOptions& options) {
  const std::string& path = options.input.input;
  if (file_of(options.input).empty()) fail_usage("--frames is for files, not for " + path);
  check_input_options(options.input);
  const Result<std::shared_ptr<const Frames>> frames =
      open_frames(path, options.input.reading.options(), FramesOptions{options.keep_index});
  if (!frames) value_or_fail(Status(frames.error()));
  warn((*frames)->warnings());
  const Summary all = summary_of(**frames);
  for (std::size_t i = 0; i < std::min(kMostWarnings, all.warnings.size()); ++i) warn(all.warnings[i]);
  if (all.warnings.size() > kMostWarnings)
    warn(std::to_string(all.warnings.size() - kMostWarnings) + " more kinds of warnings; --json lists them");
  (options.json ? print_frames_json : print_frames_text)(path, all);
}

}  // namespace bihive::cli
