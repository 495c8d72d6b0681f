#include "experiment.h"

namespace bihive::cli::thesis {

Experiment figure_4_3() {
  return {"figure-4.3", "Figure 4.3: the tree and its traversal",
          [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
