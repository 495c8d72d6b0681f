#include "commands/distributed_options.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <variant>

namespace bihive::cli {
namespace {

// Options that look at no sphere but by its centre and radius.
constexpr std::string_view kWithChunks[] = {
    "--ao",           "--ao-directions", "--ao-distance",  "--aperture",     "--axes",      "--background",
    "--bits",         "--crop",          "--dpi",          "--engine",       "--exposure",  "--eye",
    "--focus",        "--fog",           "--fov",          "--frame",        "--json",      "--layers",
    "--length-unit",  "--light",         "--light-points", "--look-at",      "--max-depth", "--max-prims",
    "--no-ao",        "--no-labels",     "--no-shadows",   "--opacity-rule", "--outline",   "--output",
    "--projection",   "--radius",        "--radius-scale", "--recenter",     "--recursion", "--samples",
    "--scale-bar",    "--shadows",       "--size",         "--style",        "--threads",   "--title",
    "--title-values", "--tone",          "--transfer",     "--turn",         "--up",        "--view",
    "--view-from",    "--zoom",          "INPUT"};

// Options for which rank 0 reads all spheres.
constexpr std::string_view kWithWholeSet[] = {
    "--assembly", "--cell",       "--cell-origin",  "--cell-vectors",    "--clip",    "--colour",  "--colour-by",
    "--columns",  "--count",      "--crease",       "--element-colours", "--film",    "--hide",    "--legend",
    "--material", "--nan-colour", "--no-hydrogens", "--no-water",        "--opacity", "--picture", "--replicate",
    "--seed",     "--select",     "--show",         "--trajectory",      "--unwrap",  "--wrap"};

bool contains(const auto& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

}  // namespace

Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options) {
  // Chunks have one frame, and a focus on a selection looks for its spheres.
  const bool by_value =
      options.input.frame.value_or(0) == 0 && (!options.focus || std::holds_alternative<double>(*options.focus));
  ReadingByRanks reading = by_value ? ReadingByRanks::chunks : ReadingByRanks::whole;
  for (const std::string& name : options.given) {
    if (contains(kWithChunks, name)) continue;
    if (!contains(kWithWholeSet, name))
      return Error{"--distribute does not work with " + name, "", 0, 0, "leave one of them out"};
    reading = ReadingByRanks::whole;
  }
  return reading;
}

}  // namespace bihive::cli
