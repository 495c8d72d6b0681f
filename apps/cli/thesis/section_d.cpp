#include "experiment.h"

namespace bihive::cli::thesis {

Experiment section_d() {
  return {"section-d", "Section D: a tree of one leaf",
          [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
