#include "commands/distributed_options.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <variant>

#include "bihive/settings/parameter.h"

namespace bihive::cli {
namespace {

constexpr ReadingByRanks chunks = ReadingByRanks::chunks, whole = ReadingByRanks::whole;

struct DistributedOption {
  std::string_view name;
  ReadingByRanks reading;
};

// The options that are no parameters of settings/parameter.h, which have a column for it. One that is not here does not
// work with --distribute.
constexpr DistributedOption kDistributedOptions[] = {
    // The picture.
    {"--aperture", chunks},
    {"--background", chunks},
    {"--bits", chunks},
    {"--crop", chunks},
    {"--dpi", chunks},
    {"--engine", chunks},
    {"--eye", chunks},
    {"--film", whole},
    {"--focus", chunks},
    {"--fov", chunks},
    {"--json", chunks},
    {"--layers", chunks},
    {"--light", chunks},
    {"--look-at", chunks},
    {"--max-depth", chunks},
    {"--max-prims", chunks},
    {"--no-labels", chunks},
    {"--outline", chunks},
    {"--output", chunks},
    {"--picture", whole},
    {"--projection", chunks},
    {"--samples", chunks},
    {"--size", chunks},
    {"--style", chunks},
    {"--threads", chunks},
    {"--title-values", chunks},
    {"--turn", chunks},
    {"--up", chunks},
    {"--view", chunks},
    {"--view-from", chunks},
    {"--zoom", chunks},
    // The input.
    {"INPUT", chunks},
    {"--assembly", whole},
    {"--cell-origin", whole},
    {"--cell-vectors", whole},
    {"--columns", whole},
    {"--count", whole},
    {"--frame", chunks},
    {"--radius", chunks},
    {"--radius-scale", chunks},
    {"--recenter", chunks},
    {"--replicate", whole},
    {"--seed", whole},
    {"--trajectory", whole},
    {"--unwrap", whole},
    {"--wrap", whole},
    // The appearance of selections.
    {"--clip", whole},
    {"--colour", whole},
    {"--colour-by", whole},
    {"--crease", whole},
    {"--element-colours", whole},
    {"--hide", whole},
    {"--material", whole},
    {"--nan-colour", whole},
    {"--no-hydrogens", whole},
    {"--no-water", whole},
    {"--opacity", whole},
    {"--select", whole},
    {"--show", whole},
};

}  // namespace

Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options) {
  // Chunks have one frame, and a focus on a selection looks for its spheres.
  const bool by_value =
      options.input.frame.value_or(0) == 0 && (!options.focus || std::holds_alternative<double>(*options.focus));
  ReadingByRanks reading = by_value ? chunks : whole;
  for (const std::string& name : options.given) {
    const auto* const found = std::find_if(std::begin(kDistributedOptions), std::end(kDistributedOptions),
                                           [&](const DistributedOption& one) { return one.name == name; });
    const Parameter* const parameter = parameter_of_option(name);
    const bool works =
        parameter != nullptr ? parameter->ranks != ParameterRanks::refused : found != std::end(kDistributedOptions);
    if (!works) return Error{"--distribute does not work with " + name, "", 0, 0, "leave one of them out"};
    const bool takes_whole = parameter != nullptr ? parameter->ranks == ParameterRanks::whole : found->reading == whole;
    if (takes_whole) reading = whole;
  }
  return reading;
}

}  // namespace bihive::cli
