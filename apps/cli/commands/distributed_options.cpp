#include "commands/distributed_options.h"

#include <variant>

#include "bihive/base/setting_name.h"
#include "bihive/job/picture_options.h"

namespace bihive::cli {

Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options) {
  // Chunks have one frame, a selection or the axes of the whole set need all spheres, and a film keeps settings of all
  // kinds.
  const bool by_value = options.input.reading.options().frame == 0 && !options.view_of &&
                        (!options.focus || std::holds_alternative<double>(*options.focus)) &&
                        (!options.look_at || std::holds_alternative<Vec3d>(*options.look_at));
  ReadingByRanks reading = by_value && options.film.empty() ? ReadingByRanks::chunks : ReadingByRanks::whole;
  for (const auto& [id, value] : options.given) {
    const RequestOption<PictureRequest>* const row = picture_option(id);
    const ParameterRanks ranks = row != nullptr ? row->ranks : ParameterRanks::refused;
    if (ranks == ParameterRanks::refused)
      return Error{"--distribute does not work with " + setting_name(id), "", 0, 0, "leave one of them out"};
    if (ranks == ParameterRanks::whole) reading = ReadingByRanks::whole;
  }
  return reading;
}

}  // namespace bihive::cli
