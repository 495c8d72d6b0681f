#include "experiment.h"

namespace bihive::cli::thesis {

Experiment figure_4_4() {
  return {"figure-4.4", "Figure 4.4: frames per second",
          [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
