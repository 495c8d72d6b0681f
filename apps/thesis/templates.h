// The report's templates, embedded in the program.
#pragma once

#include <string_view>

#include "bihive/thesis/experiments.h"

namespace bihive {

std::string_view thesis_template_report();    ///< thesis/report/report.html
std::string_view thesis_template_css();       ///< thesis/report/report.css
std::string_view thesis_template_findings();  ///< thesis/report/findings.html
std::string_view thesis_template_verdicts();  ///< thesis/report/verdicts.json

// thesis_template_figure_4_1() and so on: thesis/figure-4.1/report.html.
#define BIHIVE_DECLARE(name, id, section, title) std::string_view thesis_template_##name();
BIHIVE_THESIS_EXPERIMENTS(BIHIVE_DECLARE)
#undef BIHIVE_DECLARE

}  // namespace bihive
