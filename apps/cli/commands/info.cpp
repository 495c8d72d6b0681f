// bihive info: the content of an input, and the memory of its trees.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "bihive/bih/memory.h"
#include "bihive/io/frames.h"
#include "bihive/job/messages.h"
#include "bihive/simd/target.h"
#include "bihive/wide/wide_builder.h"
#include "commands/commands.h"
#include "commands/info_content.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

struct Range {
  std::string name;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  /// NaN means unknown and is left out.
  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  bool known() const { return min <= max; }
};

template <class T>
void add_range(std::vector<Range>& ranges, const std::string& name, const std::vector<T>& values) {
  if (values.empty()) return;
  Range range{name};
  for (const T value : values) range.add(static_cast<double>(value));
  ranges.push_back(range);
}

std::vector<Range> attribute_ranges(const SphereAttributes& attributes) {
  std::vector<Range> ranges;
  add_range(ranges, "element", attributes.element);
  add_range(ranges, "type", attributes.type);
  if (!attributes.colour.empty()) {
    Range range{"colour"};
    for (const Vec3f colour : attributes.colour)
      for (int channel = 0; channel < 3; ++channel) range.add(double(colour[channel]));
    ranges.push_back(range);
  }
  add_range(ranges, "opacity", attributes.opacity);
  for (const NamedNumbers& column : attributes.numbers) add_range(ranges, column.name, column.values);
  return ranges;
}

struct Facts {
  const Input& input;
  const SphereSet& spheres;
  SphereSet::Bounds bounds;
  Range radius{"radius"};
  std::int64_t zero_radii = 0;
  std::vector<Range> attributes;
  InfoContent content;
  InfoBonds bonds;
  std::optional<std::pair<double, double>> time_span_ps;  // times of the first and last frames
  BuildParameters parameters;
  MemoryPrediction memory;
  WideMemoryPrediction wide_memory;

  Facts(const Input& from, const TreeParameters& tree)
      : input(from),
        spheres(from.scene.spheres),
        bounds(spheres.bounds()),
        attributes(attribute_ranges(spheres.attributes())),
        content(content_of(spheres)),
        bonds(bonds_of(spheres)),
        parameters(tree.for_reference()),
        memory(predict_tree_memory(spheres.size(), parameters)),
        wide_memory(predict_wide_memory(spheres.size(), tree.for_wide(spheres.size()))) {
    for (std::int64_t id = 0; id < spheres.size(); ++id) radius.add(spheres.radius(id));
    zero_radii = std::count(spheres.r().begin(), spheres.r().end(), 0.0F);
  }
};

void print_json(const Facts& facts) {
  const auto vector = [](Vec3d v) { return ordered_json{v.x, v.y, v.z}; };
  const auto limit = [](std::int64_t value) { return value == kUnlimited ? ordered_json() : ordered_json(value); };
  const auto range = [](const MemoryPrediction::Range& r) { return ordered_json{{"low", r.low}, {"high", r.high}}; };
  const Scene& scene = facts.input.scene;
  ordered_json json = ordered_json::object();
  json["name"] = scene.name;
  json["format"] = facts.input.format;
  const auto text = [](const std::string& value) { return value.empty() ? ordered_json() : ordered_json(value); };
  json["title"] = text(facts.input.title);
  json["entry_id"] = text(facts.input.entry_id);
  json["seed"] = scene.seed ? ordered_json(*scene.seed) : ordered_json();
  json["spheres"] = facts.spheres.size();
  json["bounds"] = {{"lo", vector(facts.bounds.lo)}, {"hi", vector(facts.bounds.hi)}};
  json["radius"] = {{"min", facts.radius.min}, {"max", facts.radius.max}};
  json["zero_radii"] = facts.zero_radii;
  json["vanishing_radii"] = facts.spheres.vanishing_radii();
  json["scale_exponent"] = facts.spheres.scale_exponent();
  json["origin"] = vector(facts.spheres.origin());
  json["attributes"] = ordered_json::array();
  for (const Range& attribute : facts.attributes)
    json["attributes"].push_back({{"name", attribute.name},
                                  {"min", attribute.known() ? ordered_json(attribute.min) : ordered_json()},
                                  {"max", attribute.known() ? ordered_json(attribute.max) : ordered_json()}});
  if (const std::optional<Cell>& cell = facts.spheres.cell()) {
    json["cell"]["origin"] = vector(cell->origin);
    for (const Vec3d& edge : cell->vectors) json["cell"]["vectors"].push_back(vector(edge));
  } else {
    json["cell"] = ordered_json();
  }
  json["copies"] = facts.spheres.images().counts;
  json["frames"] = facts.input.frames;
  json["time_ps"] = facts.input.time_ps ? ordered_json(*facts.input.time_ps) : ordered_json();
  json["step"] = facts.input.step ? ordered_json(*facts.input.step) : ordered_json();
  json["time_span_ps"] =
      facts.time_span_ps ? ordered_json{facts.time_span_ps->first, facts.time_span_ps->second} : ordered_json();
  const auto counted = [](const std::vector<CountedName>& names) {
    ordered_json list = ordered_json::array();
    for (const CountedName& one : names)
      list.push_back({{"name", one.name}, {"residues", one.residues}, {"spheres", one.spheres}});
    return list;
  };
  json["chains"] = counted(facts.content.chains);
  json["residues"] = counted(facts.content.kinds);
  json["ligands"] = counted(facts.content.ligands);
  json["molecules"] = facts.content.molecules ? ordered_json(*facts.content.molecules) : ordered_json();
  json["bonds"] = {{"stated", facts.bonds.stated},
                   {"orders", ordered_json::object()},
                   {"by_distance", facts.bonds.by_distance ? ordered_json(*facts.bonds.by_distance) : ordered_json()}};
  for (const auto& [order, count] : facts.bonds.orders) json["bonds"]["orders"][order] = count;
  json["assemblies"] = facts.input.assemblies;
  json["rules"] = facts.input.rules;
  json["warnings"] = facts.input.warnings;
  json["recentred_by"] = vector(facts.input.recentred_by);
  json["camera"] = facts.input.has_camera;
  json["lights"] = facts.input.has_lights ? ordered_json(scene.lights.size()) : ordered_json();
  json["materials"] = scene.materials.size();
  json["plane"] = scene.plane.has_value();
  json["spheres_bytes"] = facts.spheres.allocated_bytes();
  json["predicted_tree"] = {{"max_prims", limit(facts.parameters.max_prims)},
                            {"max_depth", limit(facts.parameters.max_depth)},
                            {"nodes", range(facts.memory.nodes)},
                            {"compact_bytes", range(facts.memory.compact_bytes)},
                            {"allocated_bytes", range(facts.memory.allocated_bytes)}};
  json["predicted_wide_tree"] = {{"used_bytes", range({facts.wide_memory.low_bytes, facts.wide_memory.high_bytes})},
                                 {"peak_bytes", facts.wide_memory.peak_bytes}};
  json["target"] = active_target();
  print(json.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n");
}

// "A 99 residues, B 99": of each name, and how many names there are beyond the first.
std::string text_of(const std::vector<CountedName>& names, const std::string& unit = "") {
  constexpr std::size_t kMostShown = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostShown); ++i)
    text += fmt::format("{}{} {}{}", i == 0 ? "" : ", ", names[i].name.empty() ? "(none)" : names[i].name,
                        grouped(names[i].residues), i == 0 ? unit : "");
  if (names.size() > kMostShown) text += fmt::format(" and {} others", names.size() - kMostShown);
  return text;
}

// "52 stated (20 single, 2 double), 1,504 by distance"
std::string text_of(const InfoBonds& bonds) {
  std::string text = bonds.stated > 0 ? grouped(bonds.stated) + " stated" : "";
  for (std::size_t i = 0; i < bonds.orders.size(); ++i)
    text += fmt::format("{}{} {}{}", i == 0 ? " (" : ", ", grouped(bonds.orders[i].second), bonds.orders[i].first,
                        i + 1 == bonds.orders.size() ? ")" : "");
  if (bonds.by_distance.value_or(0) > 0)
    text += fmt::format("{}{} by distance", text.empty() ? "" : ", ", grouped(*bonds.by_distance));
  return text;
}

void print_text(const Facts& facts, bool with_trees) {
  const auto row = [](const std::string& name, const std::string& value) {
    print(fmt::format("  {:<18}{}\n", escaped(name), escaped(value)));
  };
  const auto interval = [](double min, double max) {
    // Adding 0 makes 0 of -0.
    return min == max ? fmt::format("{:.6g}", min + 0) : range_text(min + 0, max + 0);
  };
  const auto bytes = [](const MemoryPrediction::Range& r) {
    return readable_bytes(static_cast<double>(r.low)) + " to " + readable_bytes(static_cast<double>(r.high));
  };
  const Scene& scene = facts.input.scene;
  print(fmt::format("{}: {}, {} spheres\n", escaped(scene.name), facts.input.format, grouped(facts.spheres.size())));
  if (!facts.input.title.empty()) row("title", facts.input.title);
  if (!facts.input.entry_id.empty()) row("entry", facts.input.entry_id);
  if (facts.time_span_ps)
    row("time span", fmt::format("{:.9g} to {:.9g} ps in {} frames", facts.time_span_ps->first,
                                 facts.time_span_ps->second, grouped(facts.input.frames)));
  const InfoContent& content = facts.content;
  if (!content.chains.empty()) row("chains", text_of(content.chains, " residues"));
  if (!content.kinds.empty()) row("residues", text_of(content.kinds));
  if (!content.ligands.empty()) row("ligands and ions", text_of(content.ligands));
  if (content.molecules) row("molecules", grouped(*content.molecules));
  if (const std::string bonds = text_of(facts.bonds); !bonds.empty()) row("bonds", bonds);
  const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) row(axes[axis], interval(facts.bounds.lo[axis], facts.bounds.hi[axis]));
  row("radius", interval(facts.radius.min, facts.radius.max));
  if (facts.zero_radii > 0) row("", fmt::format("{} spheres of radius 0 are never hit", grouped(facts.zero_radii)));
  if (facts.spheres.vanishing_radii() > 0)
    row("", fmt::format("{} radii are below 2^-60 of the set's extent", grouped(facts.spheres.vanishing_radii())));
  for (const Range& attribute : facts.attributes)
    row(attribute.name, attribute.known() ? interval(attribute.min, attribute.max) : "unknown");
  if (const std::optional<Cell>& cell = facts.spheres.cell()) {
    const char* const names[] = {"cell a", "cell b", "cell c"};
    for (std::size_t k = 0; k < 3; ++k)
      row(names[k], fmt::format("{:.6g}, {:.6g}, {:.6g}", cell->vectors[k].x + 0, cell->vectors[k].y + 0,
                                cell->vectors[k].z + 0));
    if (cell->origin != Vec3d{})
      row("cell from", fmt::format("{:.6g}, {:.6g}, {:.6g}", cell->origin.x, cell->origin.y, cell->origin.z));
  }
  if (facts.spheres.has_images())
    row("copies", fmt::format("{}: {} spheres with their copies", fmt::join(facts.spheres.images().counts, " x "),
                              grouped(facts.spheres.total_size())));
  row("frames", grouped(facts.input.frames));
  if (facts.input.time_ps) row("time", fmt::format("{:.9g} ps", *facts.input.time_ps));
  if (facts.input.step) row("step", grouped(*facts.input.step));
  if (!facts.input.assemblies.empty()) row("assemblies", fmt::format("{}", fmt::join(facts.input.assemblies, ", ")));
  for (const std::string& rule : facts.input.rules) row("read as", rule);
  const Vec3d shift = facts.input.recentred_by;
  if (shift != Vec3d{}) row("recentred by", fmt::format("{}, {}, {}", shift.x, shift.y, shift.z));
  row("spheres take", readable_bytes(static_cast<double>(facts.spheres.allocated_bytes())));
  if (!with_trees) return;
  row("wide tree", bytes({facts.wide_memory.low_bytes, facts.wide_memory.high_bytes}) + ", about " +
                       readable_bytes(static_cast<double>(facts.wide_memory.peak_bytes)) + " while it is built");
  row("reference tree", bytes(facts.memory.allocated_bytes));
  row("", bytes(facts.memory.compact_bytes) + " with nodes of 12 bytes");
  row("instruction set", active_target());
}

// Times of the first and the last frame, where the file states them. Costs a pass over a text with many frames.
std::optional<std::pair<double, double>> time_span_of(const InputOptions& options, const Input& input) {
  if (input.frames < 2 || !input.time_ps || is_built_in_scene(options.input) || must_be_read_whole(options.input))
    return std::nullopt;
  const Result<std::shared_ptr<const Frames>> frames =
      open_frames(options.input, options.reading.options(), {.empty_frames = true});
  if (!frames) return std::nullopt;
  const Result<SphereFile> first = (*frames)->read(0), last = (*frames)->read((*frames)->count() - 1);
  if (!first || !last || !first->time_ps || !last->time_ps) return std::nullopt;
  return std::pair{*first->time_ps, *last->time_ps};
}

}  // namespace

void run_info(const InfoOptions& options) {
  if (options.attributes || options.frames || options.measures())
    refuse_copies(options.input, std::string(options.measures() ? "a measure"
                                             : options.frames   ? "--frames"
                                                                : "--attributes") +
                                     " looks at the stored spheres");
  if (options.measures()) return run_info_of_measures(options);
  if (options.frames) return run_info_of_frames(options);
  const Input input = load_input(options.input);
  if (options.attributes) return print_attributes(input, options.json);
  Facts facts(input, options.tree);
  facts.time_span_ps = time_span_of(options.input, input);
  if (options.json) return print_json(facts);
  print_text(facts, options.trees || options.tree.max_prims || options.tree.max_depth);
}

}  // namespace bihive::cli
