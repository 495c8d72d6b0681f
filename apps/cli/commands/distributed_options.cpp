#include "commands/distributed_options.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <variant>

#include "bihive/settings/parameter.h"

namespace bihive::cli {
namespace {

// The options that are no parameters of settings/parameter.h, where a column says it. One that is in neither table does
// not work with --distribute.

// Options that look at no sphere but by its centre and radius.
constexpr std::string_view kWithChunks[] = {
    "--aperture",     "--background", "--bits",      "--crop",      "--dpi",    "--engine",     "--eye",
    "--focus",        "--fov",        "--frame",     "--json",      "--layers", "--light",      "--look-at",
    "--max-depth",    "--max-prims",  "--no-labels", "--outline",   "--output", "--projection", "--radius",
    "--radius-scale", "--recenter",   "--samples",   "--size",      "--style",  "--threads",    "--title-values",
    "--turn",         "--up",         "--view",      "--view-from", "--zoom",   "INPUT"};

// Options for which rank 0 reads all spheres.
constexpr std::string_view kWithWholeSet[] = {
    "--assembly",     "--cell-origin", "--cell-vectors",    "--clip",    "--colour",    "--colour-by", "--columns",
    "--count",        "--crease",      "--element-colours", "--film",    "--hide",      "--material",  "--nan-colour",
    "--no-hydrogens", "--no-water",    "--opacity",         "--picture", "--replicate", "--seed",      "--select",
    "--show",         "--trajectory",  "--unwrap",          "--wrap"};

bool contains(const auto& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

ParameterRanks ranks_of_option(std::string_view name) {
  if (contains(kWithChunks, name)) return ParameterRanks::chunks;
  return contains(kWithWholeSet, name) ? ParameterRanks::whole : ParameterRanks::refused;
}

}  // namespace

Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options) {
  // Chunks have one frame, and a focus on a selection looks for its spheres.
  const bool by_value =
      options.input.frame.value_or(0) == 0 && (!options.focus || std::holds_alternative<double>(*options.focus));
  ReadingByRanks reading = by_value ? ReadingByRanks::chunks : ReadingByRanks::whole;
  for (const std::string& name : options.given) {
    const Parameter* const parameter = parameter_of_option(name);
    const ParameterRanks ranks = parameter != nullptr ? parameter->ranks : ranks_of_option(name);
    if (ranks == ParameterRanks::chunks) continue;
    if (ranks == ParameterRanks::refused)
      return Error{"--distribute does not work with " + name, "", 0, 0, "leave one of them out"};
    reading = ReadingByRanks::whole;
  }
  return reading;
}

}  // namespace bihive::cli
