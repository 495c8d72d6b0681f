#include "experiment.h"

namespace bihive::cli::thesis {

Experiment figure_4_2() {
  return {"figure-4.2", "Figure 4.2: recursion depth",
          [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
