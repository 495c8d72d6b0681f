#include "commands/distributed_options.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <variant>

#include "bihive/base/setting_name.h"
#include "bihive/io/reading_settings.h"
#include "bihive/settings/parameter.h"

namespace bihive::cli {
namespace {

// The options that are neither parameters (settings/parameter.h) nor settings of reading (io/reading_settings.h), where
// a column says it. One that is in no table does
// not work with --distribute.

// Options that look at no sphere but by its centre and radius.
constexpr std::string_view kWithChunks[] = {
    "--aperture",   "--background", "--bits",      "--crop",      "--dpi",     "--engine",
    "--eye",        "--focus",      "--fov",       "--json",      "--layers",  "--light",
    "--look-at",    "--max-depth",  "--max-prims", "--no-labels", "--outline", "--output",
    "--projection", "--samples",    "--size",      "--style",     "--threads", "--title-values",
    "--turn",       "--up",         "--view",      "--view-from", "--zoom",    "INPUT"};

// Options for which rank 0 reads all spheres.
constexpr std::string_view kWithWholeSet[] = {
    "--clip",    "--colour",  "--colour-by", "--count",      "--crease",       "--element-colours",
    "--film",    "--hide",    "--material",  "--nan-colour", "--no-hydrogens", "--no-water",
    "--opacity", "--picture", "--seed",      "--select",     "--show"};

bool contains(const auto& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

ParameterRanks ranks_of_option(std::string_view name) {
  if (contains(kWithChunks, name)) return ParameterRanks::chunks;
  for (const ReadingSetting& row : reading_settings())
    if (option_of_setting(row.id) == name) return row.with_chunks ? ParameterRanks::chunks : ParameterRanks::whole;
  return contains(kWithWholeSet, name) ? ParameterRanks::whole : ParameterRanks::refused;
}

}  // namespace

Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options) {
  // Chunks have one frame, and a focus on a selection looks for its spheres.
  const bool by_value =
      options.input.reading.options().frame == 0 && (!options.focus || std::holds_alternative<double>(*options.focus));
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
