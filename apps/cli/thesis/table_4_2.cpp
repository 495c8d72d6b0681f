#include "experiment.h"

namespace bihive::cli::thesis {

Experiment table_4_2() {
  return {"table-4.2", "Table 4.2: tree statistics", [](const Settings&, const Values&) { return std::vector<Step>(); },
          [](const SectionContext&) { return Section(); }};
}

}  // namespace bihive::cli::thesis
