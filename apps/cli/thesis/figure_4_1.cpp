#include "experiment.h"

namespace bihive::cli::thesis {

Experiment figure_4_1() {
  return {"figure-4.1", "Figure 4.1: the three scenarios",
          [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
