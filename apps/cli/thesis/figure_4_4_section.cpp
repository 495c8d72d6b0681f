// The section of Figure 4.4: first the costs at which the text's winner wins, then the counts without a clock, then the
// engines, then the lost bars.
#include <fmt/format.h>

#include "thesis/figure_4_4.h"

namespace bihive::cli::thesis {

Section figure_4_4_section(const SectionContext& context) {
  Section section;
  section.paragraphs.push_back(
      "Each configuration draws the same picture: primary rays only, the same shading, no shadows, so that only the "
      "search for the first hit differs. BF tests every sphere; BIH n is a tree with at most n spheres a leaf. Brute "
      "force and all trees of a configuration take turns, round by round; the first round does not count, and the "
      "median of the others does, with their quartiles. A frame has a cost that no tree takes away: making the rays, "
      "shading what they hit, storing the radiance.");
  for (const auto& [name, result] : context.results)
    if (name != kFloorStep && result.is_object() && result.contains("width_px")) {
      section.paragraphs.push_back(fmt::format(
          "The picture has {} x {} pixels{}.", result["width_px"].get<int>(), result["height_px"].get<int>(),
          context.settings.quick ? fmt::format(" in this quick run, where the full run has {} x {}",
                                               context.values.integer("width_px"), context.values.integer("height_px"))
                                 : ""));
      break;
    }
  add_winner(context, section);
  add_counts(context, section);
  add_engines(context, section);
  add_floor(context, section);
  add_lost_bars(context, section);
  return section;
}

}  // namespace bihive::cli::thesis
