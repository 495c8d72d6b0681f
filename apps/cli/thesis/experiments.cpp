// The experiments in the order of the report.
#include "thesis/experiment.h"

namespace bihive::cli::thesis {

std::vector<Experiment> all_experiments() {
  return {figure_4_1(), figure_4_2(), figure_4_3(), table_4_2(), figure_4_4(), figure_4_5(), section_d()};
}

}  // namespace bihive::cli::thesis
