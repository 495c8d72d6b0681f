#include "experiment.h"

namespace bihive::cli::thesis {

Experiment figure_4_5() {
  return {"figure-4.5", "Figure 4.5: memory", [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
